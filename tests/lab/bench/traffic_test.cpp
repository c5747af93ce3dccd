// What frames fetch and move: held against passes whose counts can be told by head.

#include "lab/bench/traffic.h"
#include "tests/gpu/with_device.h"
#include "tests/spirv/missing.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace tegument;
using namespace tegument::bench;

namespace {

constexpr std::uint64_t kTexels = 32 * 16; // of gWideMap
constexpr std::uint64_t kHalves = 8;       // bytes
constexpr std::uint64_t kFloats = 16;
constexpr std::uint64_t kSmall = 4 * 4;
constexpr int kPicture = 64;

class FrameTraffic : public test::WithDevice, public testing::WithParamInterface<Compiler> {
protected:
    void SetUp() override {
        test::WithDevice::SetUp();
        if (const std::string missing = test::compilerMissing(GetParam()); !missing.empty()) GTEST_SKIP() << missing;
    }

    std::vector<Traffic> count(const std::string& technique, double turns = 5) {
        const Scene scene{.name = "none", .file = {}, .workspace = {}, .mesh = {}};
        const Contest contest{.scene = scene, .width = kPicture, .height = kPicture, .mapSize = 64, .compiler = GetParam()};
        const Contender contender{.technique = technique,
                                  .setting = "corrected",
                                  .variant = {},
                                  .source = {},
                                  .effect = "tests/lab/bench/fixtures/counts.fx",
                                  .defines = {},
                                  .parameters = {{"gTurns", {turns}}}};
        const auto traffic = trafficOf(*device_, contest, contender);
        EXPECT_TRUE(traffic) << format(traffic.error());
        return traffic ? *traffic : std::vector<Traffic>{};
    }

    static Traffic passOf(const std::vector<Traffic>& all, const std::string& name) {
        const auto found = std::ranges::find(all, name, &Traffic::pass);
        EXPECT_NE(found, all.end()) << name;
        return found == all.end() ? Traffic{} : *found;
    }
};

} // namespace

INSTANTIATE_TEST_SUITE_P(By, FrameTraffic, testing::Values(Compiler::Dxc, Compiler::Glslang), test::compilerTestName);

TEST_P(FrameTraffic, a_pass_is_called_for_each_pixel_of_its_target_and_writes_all_of_it) {
    const Traffic fill = passOf(count("Counts"), "Fill");
    EXPECT_EQ(fill.calls, kSmall);
    EXPECT_EQ(fill.fetches, 0U);
    EXPECT_EQ(fill.read, 0U);
    EXPECT_EQ(fill.written, kSmall * kFloats);
}

TEST_P(FrameTraffic, look_ups_in_a_loop_count_as_often_as_it_turns) {
    EXPECT_EQ(passOf(count("Counts", 5), "Loop").fetches, 7 * kTexels);
    EXPECT_EQ(passOf(count("Counts", 11), "Loop").fetches, 13 * kTexels);
}

TEST_P(FrameTraffic, no_more_is_read_of_a_texture_than_it_holds) {
    const Traffic loop = passOf(count("Counts"), "Loop");
    EXPECT_EQ(loop.read, kSmall * kFloats);
    EXPECT_EQ(loop.written, kTexels * kHalves);
}

TEST_P(FrameTraffic, a_branch_that_is_not_taken_costs_no_look_up) {
    const Traffic branch = passOf(count("Counts"), "Branch");
    constexpr std::uint64_t kPixels = kPicture * kPicture;
    EXPECT_EQ(branch.calls, kPixels);
    EXPECT_EQ(branch.fetches, 2 * kPixels / 4);
    EXPECT_EQ(branch.read, kTexels * kHalves + kSmall * kFloats) << "both maps whole: each is looked up more often than it has texels";
}

TEST_P(FrameTraffic, compute_shaders_count_what_they_read_and_store) {
    const Traffic other = passOf(count("CountsCompute"), "EveryOther");
    EXPECT_EQ(other.calls, kTexels);
    EXPECT_EQ(other.fetches, kTexels);
    EXPECT_EQ(other.read, kTexels * kHalves);
    EXPECT_EQ(other.written, kTexels / 2 * kHalves);
}

TEST_P(FrameTraffic, passes_come_in_the_order_of_the_frame) {
    std::vector<std::string> names;
    for (const Traffic& pass : count("CountsCompute"))
        names.push_back(pass.pass);
    EXPECT_EQ(names, (std::vector<std::string>{"Fill", "Loop", "EveryOther", "Branch"}));
}
