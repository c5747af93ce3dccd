// Every target that a Direct3D engine has drawn against the one that Vulkan drew.

#include "host/support/file.h"
#include "tests/d3d/difference.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <ostream>

namespace tegument::test {
namespace {

struct Comparison {
    std::size_t drawn = 0; // index into allCases()
    Engine engine = Engine::Direct3D9;
};

/// Instead of the bytes.
void PrintTo(const Comparison& comparison, std::ostream* out) {
    *out << allCases().at(comparison.drawn).name() << " on " << engineName(comparison.engine);
}

std::vector<Comparison> comparisons() {
    std::vector<Comparison> all;
    for (std::size_t i = 0; i < allCases().size(); ++i)
        for (const Engine engine : kDirect3D)
            all.push_back({i, engine});
    return all;
}

class Drawn : public testing::TestWithParam<Comparison> {};

TEST_P(Drawn, as_vulkan_draws_it) {
    const Case& drawn = allCases().at(GetParam().drawn);
    const Engine engine = GetParam().engine;
    if (const auto missing = readFile(missingFile())) GTEST_SKIP() << *missing;
    const auto status = readFile(statusFile(drawn, engine));
    if (!status) GTEST_SKIP() << "not drawn: run the tests of label d3d through ctest, which draws first";
    ASSERT_EQ(*status, "ok");
    for (const DrawnTarget& target : targetsOf(drawn)) {
        if (!readable(engine, target)) continue;
        const auto found = distance(drawn, engine, target);
        ASSERT_TRUE(found) << format(found.error());
        const Exception* exception = exceptionFor(drawn, engine, target);
        const std::string where =
            fmt::format("{}: {} of {} pixels beyond {:g}; largest {:g} at ({}, {}), 99.9 % within {:g}", target.name, found->beyond,
                        found->pixels, tolerance(target.kind), found->largest, found->x, found->y, found->p999);
        EXPECT_LE(static_cast<double>(found->beyond), exception ? exception->beyond * static_cast<double>(found->pixels) : 0) << where;
        EXPECT_LE(found->largest, exception ? exception->largest : tolerance(target.kind)) << where;
    }
}

std::string comparisonName(const testing::TestParamInfo<Comparison>& tested) {
    return allCases().at(tested.param.drawn).name() + "_on_" + engineName(tested.param.engine);
}

INSTANTIATE_TEST_SUITE_P(Engines, Drawn, testing::ValuesIn(comparisons()), comparisonName);

} // namespace
} // namespace tegument::test
