// Compute passes of effects: what they write is what later passes read, by both compilers.

#include "tests/run/fixture.h"
#include "tests/spirv/missing.h"

#include <algorithm>

namespace tegument::test {
namespace {

class ComputeRun : public Run, public testing::WithParamInterface<Compiler> {
protected:
    static RunOptions picture(const std::string& technique, int width = 16, int height = 8) {
        return {.technique = technique, .width = width, .height = height, .compiler = GetParam()};
    }

    void SetUp() override {
        Run::SetUp();
        if (const std::string missing = compilerMissing(GetParam()); !missing.empty()) GTEST_SKIP() << missing;
    }

    Result<RunResult> draw(const RunOptions& options) { return run("compute.fx", options); }
};

TEST_P(ComputeRun, a_thread_for_each_texel_writes_it) {
    RunOptions options = picture("Numbers");
    options.parameters["gStep"] = {0.25};
    const auto result = draw(options);
    ASSERT_TRUE(succeeded(result));
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_TRUE(pixelIs(result->image, x, y, {static_cast<float>(x), static_cast<float>(y), 0.25F, 1}));
}

TEST_P(ComputeRun, threads_of_a_group_share_what_they_have_read) {
    const auto result = draw(picture("Reversed"));
    ASSERT_TRUE(succeeded(result));
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_TRUE(pixelIs(result->image, x, y, {2.0F * static_cast<float>(15 - x), 2.0F * static_cast<float>(y), 2, 2}));
}

TEST_P(ComputeRun, groups_are_counted_by_numbers_or_by_a_parameter) {
    RunOptions options = picture("Counted");
    options.parameters["gCount"] = {2, 4};
    const auto result = draw(options);
    ASSERT_TRUE(succeeded(result));
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) {
            const bool given = x < 2 && y < 4;
            const bool any = given || (x < 3 && y < 2);
            EXPECT_TRUE(pixelIs(result->image, x, y,
                                {given ? 2.0F
                                 : any ? 1.0F
                                       : 0.0F,
                                 any ? static_cast<float>(x) : 0, any ? static_cast<float>(y) : 0, 0}));
        }
}

TEST_P(ComputeRun, the_last_groups_may_reach_over_the_targets_border_and_the_viewport_is_that_target) {
    const auto result = draw(picture("Wide", 19, 9));
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 18, 8, {18, 8, 19, 9})) << "written through a name of its own";
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {0, 0, 19, 9}));
}

TEST_P(ComputeRun, the_viewport_is_the_picture_or_another_target_where_a_pass_says_so) {
    const auto asPicture = draw(picture("WideAsPicture", 38, 18));
    ASSERT_TRUE(succeeded(asPicture));
    EXPECT_TRUE(pixelIs(asPicture->image, 37, 17, {18, 8, 38, 18}));
    const auto asOther = draw(picture("WideAsOther", 19, 9));
    ASSERT_TRUE(succeeded(asOther));
    EXPECT_TRUE(pixelIs(asOther->image, 18, 8, {18, 8, 16, 8}));
}

TEST_P(ComputeRun, mip_chains_are_made_of_what_was_written) {
    const auto result = draw(picture("Chain", 1, 1));
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {2, 7.5F, 0, 1}, 1e-3F)) << "the mean of 16 x 16 texels";
}

TEST_P(ComputeRun, passes_are_reported_in_order_and_frames_are_alike) {
    RunOptions options = picture("Reversed");
    options.frames = 3;
    const auto thrice = draw(options);
    const auto once = draw(picture("Reversed"));
    ASSERT_TRUE(succeeded(thrice) && succeeded(once));
    EXPECT_EQ(thrice->image.pixels, once->image.pixels);
    std::vector<std::string> names;
    for (const PassReport& pass : thrice->passes)
        names.push_back(pass.name);
    EXPECT_EQ(names, (std::vector<std::string>{"Number", "Reverse", "Show"}));
}

TEST_P(ComputeRun, a_texture_is_not_read_and_written_in_one_pass) {
    EXPECT_EQ(code(draw(picture("Feedback"))), 4024);
}

TEST_P(ComputeRun, what_is_written_belongs_to_a_target) {
    EXPECT_EQ(code(draw(picture("Nowhere"))), 4062);
}

TEST_P(ComputeRun, a_pass_says_how_many_groups_run) {
    EXPECT_EQ(code(draw(picture("Uncounted"))), 4063);
    EXPECT_EQ(code(draw(picture("Odd"))), 4063) << "-1 groups";
}

INSTANTIATE_TEST_SUITE_P(Compilers, ComputeRun, testing::Values(Compiler::Dxc, Compiler::Glslang), compilerTestName);

} // namespace
} // namespace tegument::test
