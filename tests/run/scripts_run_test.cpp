// Scripts that draw: loops, targets, clears, depth, mips, errors before the GPU sees them.

#include "tests/run/fixture.h"

#include <algorithm>

namespace tegument::test {
namespace {

class Scripts : public Run {
protected:
    static RunOptions picture(const std::string& technique, std::vector<std::string> dump = {}) {
        return {.technique = technique, .width = 16, .height = 8, .compiler = defaultCompiler(), .dump = std::move(dump)};
    }

    Result<RunResult> draw(const RunOptions& options, const Workspace& workspace = {}) {
        return run("scripts.fx", options, nullptr, workspace);
    }
};

const TargetReport* find(const RunResult& result, const std::string& name) {
    const auto found = std::ranges::find(result.targets, name, &TargetReport::name);
    return found == result.targets.end() ? nullptr : &*found;
}

TEST_F(Scripts, a_loop_runs_its_body_with_indices_from_zero) {
    const auto result = draw(picture("Loop"));
    ASSERT_TRUE(succeeded(result));
    for (int x = 0; x < 4; ++x)
        EXPECT_TRUE(pixelIs(result->image, x, 0, {static_cast<float>(x + 1), 4, 16, 8}));
    EXPECT_TRUE(pixelIs(result->image, 4, 0, {0, 0, 0, 0})) << "no fifth execution";
}

TEST_F(Scripts, the_count_of_a_loop_can_be_set) {
    RunOptions options = picture("Loop");
    options.parameters["gCount"] = {6};
    const auto result = draw(options);
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.at(5, 0, 0), 6.0F);
}

TEST_F(Scripts, every_execution_of_a_pass_is_reported_in_order) {
    const auto result = draw(picture("Loop"));
    ASSERT_TRUE(succeeded(result));
    std::vector<std::string> names;
    for (const PassReport& pass : result->passes)
        names.push_back(pass.name);
    EXPECT_EQ(names, (std::vector<std::string>{"Mark", "Mark", "Mark", "Mark", "Show"}));
}

TEST_F(Scripts, pass_times_are_positive_where_the_device_has_timestamps) {
    if (!device_->info().timestamps) GTEST_SKIP() << "no timestamps on " << device_->info().name;
    RunOptions options = picture("Loop");
    options.warmUpFrames = 1;
    options.frames = 3;
    const auto result = draw(options);
    ASSERT_TRUE(succeeded(result));
    for (const PassReport& pass : result->passes)
        EXPECT_GT(pass.milliseconds, 0) << pass.name;
}

TEST_F(Scripts, a_second_frame_gives_the_same_picture) {
    RunOptions options = picture("PingPong");
    options.frames = 3;
    const auto once = draw(picture("PingPong"));
    const auto thrice = draw(options);
    ASSERT_TRUE(succeeded(once));
    ASSERT_TRUE(succeeded(thrice));
    EXPECT_EQ(once->image.pixels, thrice->image.pixels);
}

TEST_F(Scripts, passes_behind_a_loop_of_no_turns_are_not_compiled) {
    EXPECT_TRUE(succeeded(draw(picture("ZeroLoop"))));
    RunOptions once = picture("OneLoop");
    once.parameters["gTotal"] = {1};
    EXPECT_FALSE(draw(once)) << "the same pass does not compile when it is run";
}

TEST_F(Scripts, targets_behind_a_loop_of_no_turns_are_not_allocated) {
    const auto result = draw(picture("ZeroLoop"));
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(find(*result, "gSecondMap"), nullptr);
}

TEST_F(Scripts, two_targets_of_different_formats_are_written_at_once) {
    const auto result = draw(picture("Several", {"gByteMap", "gHalfMap"}));
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(
        pixelIs(result->dumped.at("gByteMap"), 3, 3, {0.5F, 0.25F, 0.125F, 1}, 0.51F / 255)); // half a step of 8 bits, 0.5 lies between two
    EXPECT_TRUE(pixelIs(result->dumped.at("gHalfMap"), 3, 3, {0.1F, 2.5F}, 1e-4F));           // one step of a half at 0.1 is 6e-5
}

TEST_F(Scripts, dumps_have_the_channels_of_their_formats) {
    const auto result = draw(picture("Several", {"all"}));
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->dumped.at("gByteMap").channels, 4);
    EXPECT_EQ(result->dumped.at("gHalfMap").channels, 2);
    EXPECT_EQ(result->dumped.size(), 2U);
}

TEST_F(Scripts, a_depth_target_is_dumped_as_one_channel) {
    const auto result = draw(picture("Cull", {"gDepthMap"}));
    ASSERT_TRUE(succeeded(result));
    const Image& depth = result->dumped.at("gDepthMap");
    EXPECT_EQ(depth.channels, 1);
    EXPECT_NEAR(depth.at(0, 0, 0), 0.5F, 1e-7) << "one step of 24 bits";
    EXPECT_EQ(depth.at(15, 0, 0), 0.0F);
}

TEST_F(Scripts, a_bound_target_that_the_shader_does_not_write_keeps_its_contents) {
    const auto result = draw(picture("Unwritten", {"all"}));
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->dumped.at("gFirstMap"), 5, 5, {1, 2, 3, 4}));
    EXPECT_TRUE(pixelIs(result->dumped.at("gSecondMap"), 5, 5, {0.25F, 0.5F, 0.75F, 1}));
}

TEST_F(Scripts, each_pass_reads_what_the_pass_before_has_written) {
    const auto result = draw(picture("PingPong"));
    ASSERT_TRUE(succeeded(result));
    // x -> 2x + 1, four times: 16 x + 15.
    EXPECT_TRUE(pixelIs(result->image, 7, 3, {31, 47, 63, 79}));
}

TEST_F(Scripts, a_prepass_with_greater_culls_what_equal_then_draws) {
    const auto result = draw(picture("Cull", {"gFirstMap"}));
    ASSERT_TRUE(succeeded(result));
    const Image& map = result->dumped.at("gFirstMap");
    for (int x = 0; x < 16; ++x)
        EXPECT_EQ(map.at(x, 4, 0), x < 8 ? 0.0F : 1.0F) << x;
}

TEST_F(Scripts, a_depth_target_can_be_sampled_in_a_later_pass) {
    const auto result = draw(picture("DepthRead"));
    ASSERT_TRUE(succeeded(result));
    EXPECT_NEAR(result->image.at(0, 0, 0), 0.5F, 1e-7) << "one step of 24 bits";
    EXPECT_EQ(result->image.at(15, 0, 0), 0.0F);
}

TEST_F(Scripts, v_is_zero_in_the_top_row_of_a_quad) {
    const auto result = draw(picture("Orientation"));
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {0.5F / 16, 0.5F / 8, 16, 8}, 1e-6F)); // interpolation in float
    EXPECT_TRUE(pixelIs(result->image, 15, 7, {15.5F / 16, 7.5F / 8, 16, 8}, 1e-6F));
}

TEST_F(Scripts, the_viewport_size_follows_the_target) {
    RunOptions options = picture("Orientation", {"gFirstMap"});
    options.width = 20;
    const auto result = draw(options);
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->dumped.at("gFirstMap").at(0, 0, 2), 16.0F);
    EXPECT_EQ(result->image.at(0, 0, 2), 20.0F);
}

TEST_F(Scripts, a_target_sampled_while_bound_is_refused) {
    const auto result = draw(picture("Feedback"));
    ASSERT_EQ(code(result), 4024);
    EXPECT_EQ(result.error().diagnostics.front().text, "pass Double samples gFirstMap while drawing into it");
}

TEST_F(Scripts, a_target_sampled_before_it_is_drawn_reads_zeros_with_a_warning) {
    const auto result = draw(picture("ReadFirst"));
    ASSERT_TRUE(succeeded(result));
    ASSERT_EQ(result->warnings.size(), 1U);
    EXPECT_EQ(result->warnings.front().code, 4026);
    EXPECT_TRUE(pixelIs(result->image, 8, 4, {0, 0, 0, 0}));
}

TEST_F(Scripts, the_smallest_mip_of_a_target_is_its_mean) {
    const auto result = draw(picture("Mips"));
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {0.25F, 0.25F, 0.25F, 0.25F}, 1e-6F)); // powers of two: exact but for the filter's arithmetic
}

TEST_F(Scripts, a_viewport_ratio_follows_the_picture) {
    const auto result = draw(picture("Ratio"));
    ASSERT_TRUE(succeeded(result));
    const TargetReport* target = find(*result, "gRatioMap");
    ASSERT_NE(target, nullptr);
    EXPECT_EQ(target->width, 8);
    EXPECT_EQ(target->height, 2);
    EXPECT_EQ(target->format, "R32F");
    EXPECT_EQ(target->bytes, 8U * 2U * 4U);
}

TEST_F(Scripts, a_depth_test_against_a_target_of_another_size_is_refused) {
    RunOptions options = picture("OtherSize");
    options.width = 32;
    EXPECT_EQ(code(draw(options)), 4025);
}

TEST_F(Scripts, clearing_before_any_target_clears_the_picture) {
    const auto result = draw(picture("ClearOnly"));
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 3, 3, {0.25F, 0.5F, 0.75F, 1})) << "depth was cleared to 0.25, so that EQUAL at 0 draws nothing";
}

TEST_F(Scripts, an_external_scene_is_the_background) {
    Workspace workspace;
    workspace.background = {0.5F, 0.25F, 0.125F};
    const auto result = draw(picture("External"), workspace);
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 3, 3, {0.5F, 0.25F, 0.125F, 0}));
}

TEST_F(Scripts, the_picture_is_not_among_the_dumps) {
    const auto result = draw(picture("Several", {"all"}));
    ASSERT_TRUE(succeeded(result));
    for (const auto& dumped : result->dumped)
        EXPECT_EQ(dumped.first.front(), 'g');
}

TEST_F(Scripts, dumping_a_target_that_is_not_used_is_an_error_with_the_nearest_name) {
    const auto result = draw(picture("Several", {"gHalfMop"}));
    ASSERT_EQ(code(result), 4029);
    EXPECT_EQ(result.error().diagnostics.front().hint, "did you mean 'gHalfMap'?");
}

TEST_F(Scripts, a_picture_without_pixels_is_an_error) {
    RunOptions options = picture("Ratio");
    options.width = 0;
    options.height = 0;
    EXPECT_EQ(code(draw(options)), 4004);
}

TEST_F(Scripts, a_picture_beyond_the_limit_is_an_error) {
    RunOptions options = picture("Ratio");
    options.width = 100000;
    EXPECT_EQ(code(draw(options)), 4004);
}

TEST_F(Scripts, pictures_say_how_they_were_made) {
    const auto result = draw(picture("Several", {"gHalfMap"}));
    ASSERT_TRUE(succeeded(result));
    const auto& metadata = result->image.metadata;
    EXPECT_EQ(metadata.at("effect"), "scripts.fx");
    EXPECT_EQ(metadata.at("technique"), "Several");
    EXPECT_FALSE(metadata.contains("setting")) << "this effect has none";
    EXPECT_FALSE(metadata.contains("map_size"));
    EXPECT_EQ(metadata.at("device"), device_->info().name);
    EXPECT_EQ(metadata.at("compiler"), compilerName(defaultCompiler()));
    EXPECT_EQ(result->dumped.at("gHalfMap").metadata.at("target"), "gHalfMap");
}

TEST_F(Scripts, pictures_say_what_the_effect_wants_said) {
    const auto result = run("product.fx", row(4, ""), nullptr, {}, {.defines = {{"GREEN", "0.25"}}, .setting = "loud"});
    ASSERT_TRUE(succeeded(result));
    const auto& metadata = result->image.metadata;
    EXPECT_EQ(metadata.at("setting"), "loud");
    EXPECT_EQ(metadata.at("green"), "0.25");
    EXPECT_EQ(metadata.at("gain"), "8") << "a parameter's value; its default follows the setting";
    RunOptions set = row(4, "");
    set.parameters["gGain"] = {3};
    const auto other = run("product.fx", set);
    ASSERT_TRUE(succeeded(other));
    EXPECT_EQ(other->image.metadata.at("setting"), "quiet");
    EXPECT_EQ(other->image.metadata.at("gain"), "3");
}

class BadTargets : public Run, public testing::WithParamInterface<std::pair<const char*, int>> {};

TEST_P(BadTargets, are_refused_with_a_position) {
    const auto result = run("targets.fx", row(4, GetParam().first));
    ASSERT_EQ(code(result), GetParam().second);
    EXPECT_GT(result.error().diagnostics.front().at.line, 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, BadTargets,
                         testing::Values(std::pair("Unknown", 4020), std::pair("Empty", 4021), std::pair("Huge", 4021),
                                         std::pair("Wrong", 4022)),
                         [](const auto& entry) { return std::string(entry.param.first); });

class Refused : public Run, public testing::WithParamInterface<std::pair<const char*, int>> {};

TEST_P(Refused, with_one_clear_message) {
    EXPECT_EQ(code(run("refused.fx", row(4, GetParam().first))), GetParam().second);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Refused,
                         testing::Values(std::pair("NoVertexShader", 4002), std::pair("Arguments", 4003), std::pair("Coloured", 4042),
                                         std::pair("Volume", 4032), std::pair("CubeTarget", 4023), std::pair("Unclear", 4033),
                                         std::pair("Hidden", 4005), std::pair("HiddenMap", 4005)),
                         [](const auto& entry) { return std::string(entry.param.first); });

TEST_F(Scripts, an_effect_without_techniques_is_refused) {
    EXPECT_EQ(code(run("empty.fx", picture(""))), 4001);
}

TEST_F(Scripts, an_unknown_technique_is_refused) {
    EXPECT_FALSE(draw(picture("Lop")));
}

} // namespace
} // namespace tegument::test
