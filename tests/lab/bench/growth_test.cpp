// What grows with what, from measured times.

#include "lab/bench/growth.h"
#include "tests/gpu/with_device.h"

#include <gtest/gtest.h>

using namespace tegument;
using namespace tegument::bench;

namespace {

class BenchTimes : public test::WithDevice {};

} // namespace

TEST_F(BenchTimes, growth_is_measured_at_four_sizes_of_each_quantity) {
    // A software device compiles in the first frame, and other work may take any single one.
    const auto all =
        measureGrowth(*device_, {.effects = "effects", .compiler = defaultCompiler(), .frames = {.warmUp = 1, .timed = 7}, .small = true},
                      [](const std::string&) {});
    ASSERT_TRUE(all) << format(all.error());
    for (const Growth& growth : *all) {
        EXPECT_EQ(growth.x.size(), 4) << growth.what;
        EXPECT_GT(growth.law.exponent, 0) << growth.what;
    }
}
