// The arrows between targets, from effects as they are read and planned, without a GPU; and from passes written by hand.
// Times of passes over the last frames.
// What stands under the cursor, and how values are spread.

#include "host/effect/load.h"
#include "host/run/describe.h"
#include "meshprep/adopt/adopt.h"
#include "tools/view/graph.h"
#include "tools/view/panel.h"
#include "tools/view/pass_times.h"
#include "tools/view/probe.h"
#include "tools/view/state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace tegument::view {

namespace {

Mesh oneTriangle() {
    Mesh mesh;
    mesh.name = "triangle";
    mesh.positions = {{-10, 10, 0}, {-10, -10, 0}, {10, 10, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.tangents.assign(3, {1, 0, 0, 1});
    mesh.uvs = {{0, 0}, {0, 1}, {1, 0}};
    mesh.indices = {0, 1, 2};
    computeBounds(mesh);
    return mesh;
}

/// As a session would have it, for one mesh.
SessionFrame planned(const Effect& effect, const std::string& technique) {
    const Mesh mesh = oneTriangle();
    const Workspace workspace;
    const RunOptions options{.technique = technique, .width = 64, .height = 64, .compiler = defaultCompiler()};
    const auto prepared = run::prepare({.effect = effect, .mesh = &mesh, .workspace = workspace, .options = options});
    EXPECT_TRUE(prepared) << (prepared ? "" : format(prepared.error()));
    SessionFrame frame;
    if (!prepared) return frame;
    for (const auto& target : prepared->targets)
        if (!run::isCallers(target.first)) frame.targets.push_back(target.first);
    for (const run::Step& step : prepared->plan.steps)
        if (const auto* draw = std::get_if<run::DrawStep>(&step)) frame.passes.push_back(run::describe(*draw, *prepared));
    return frame;
}

SessionFrame plannedOwn(const char* file, const std::string& technique) {
    const auto effect = loadEffect(file, {});
    EXPECT_TRUE(effect) << (effect ? "" : format(effect.error()));
    return effect ? planned(*effect, technique) : SessionFrame();
}

SessionFrame plannedForeign(const char* file) {
    auto effect = loadEffect(file, {.lenient = true});
    EXPECT_TRUE(effect) << (effect ? "" : format(effect.error()));
    return effect ? planned(adopted(std::move(*effect)).effect, {}) : SessionFrame();
}

bool has(const std::vector<TargetArrow>& arrows, const std::string& from, const std::string& to) {
    return std::ranges::any_of(arrows, [&](const TargetArrow& arrow) { return arrow.from == from && arrow.to == to; });
}

SessionPass passOf(const char* name, const std::vector<std::string>& reads, const std::vector<std::string>& writes) {
    return {.name = name, .object = 0, .targets = writes, .reads = reads, .writes = writes};
}

SessionFrame timed(std::vector<std::pair<std::string, double>> passes, std::optional<double> resolve = {}) {
    SessionFrame frame;
    for (auto& [name, milliseconds] : passes)
        frame.passes.push_back({.name = name, .milliseconds = milliseconds, .kept = milliseconds == 0});
    frame.resolveMilliseconds = resolve;
    return frame;
}

Image ramp(int width, int height, int channels) {
    Image image{.width = width, .height = height, .channels = channels};
    for (int i = 0; i < width * height * channels; ++i)
        image.pixels.push_back(static_cast<float>(i + 1));
    return image;
}

} // namespace

TEST(Arrows, of_passes_in_a_loop_are_one_each_way_with_how_often) {
    const auto arrows = arrowsOf(plannedOwn("tests/run/fixtures/scripts.fx", "PingPong"));
    const std::vector<TargetArrow> expected = {
        {"gFirstMap", "gSecondMap", {"Double"}, 4}, {"gSecondMap", "gFirstMap", {"AddOne"}, 4}, {"gFirstMap", "", {"Show"}, 1}};
    EXPECT_EQ(arrows, expected);
}

TEST(Arrows, of_a_target_that_several_passes_read_go_to_each_and_back_through_none) {
    const SessionFrame frame = plannedOwn("effects/Main.fx", "DEonLuebke");
    const auto arrows = arrowsOf(frame);
    for (const char* level : {"gIrradiance2Map", "gIrradiance6Map", "gTsmMap"})
        EXPECT_TRUE(has(arrows, level, "")) << level;
    EXPECT_FALSE(has(arrows, "gIrradianceMap", "")) << "the last pass finds light without blur by itself (final.fxh)";
    EXPECT_TRUE(has(arrows, "gIrradianceMap", "gIrradianceUMap"));
    EXPECT_TRUE(has(arrows, "gIrradianceUMap", "gIrradiance2Map"));
    EXPECT_TRUE(has(arrows, "gTsmMap", "gIrradianceMap")) << "thickness from the light's map";
    EXPECT_FALSE(has(arrows, "", "gIrradianceMap"));
    EXPECT_FALSE(has(arrows, "gTsmMap", "gTsmDepthMap")) << "a pass that has colours is no arrow to its depth";
}

TEST(Arrows, of_foreign_effects_are_found_behind_their_samplers) {
    const auto arrows = arrowsOf(plannedForeign("tests/adopt/effects/composer_glow.fx"));
    const std::vector<TargetArrow> expected = {{"gScnMap", "gGlowMap1", {"BlurH"}, 1},
                                               {"gGlowMap1", "gGlowMap2", {"BlurV"}, 1},
                                               {"gGlowMap2", "", {"Comp"}, 1},
                                               {"gScnMap", "", {"Comp"}, 1}};
    EXPECT_EQ(arrows, expected);
}

TEST(Arrows, of_a_pass_that_samples_what_it_draws_into_come_back_to_it) {
    const auto arrows = arrowsOf(plannedForeign("tests/adopt/effects/engine_post.fx"));
    EXPECT_TRUE(has(arrows, "bloomRT", "bloomRT")) << "a copy counts as the target";
    EXPECT_TRUE(has(arrows, "sceneRT", "bloomRT"));
    EXPECT_TRUE(std::ranges::none_of(arrows, [](const TargetArrow& arrow) { return arrow.from.starts_with('<'); }));
}

TEST(Arrows, keep_the_order_of_the_frame_and_each_pass_once) {
    SessionFrame frame;
    frame.passes = {passOf("A", {"gOne"}, {"gTwo", "gThree"}), passOf("B", {"gOne"}, {"gTwo"}), passOf("A", {"gOne"}, {"gTwo"})};
    const std::vector<TargetArrow> expected = {{"gOne", "gTwo", {"A", "B"}, 3}, {"gOne", "gThree", {"A"}, 1}};
    EXPECT_EQ(arrowsOf(frame), expected);
    EXPECT_EQ(arrowText(expected, "gTwo"), "from gOne by A, B, 3 times\n");
    EXPECT_EQ(arrowText(expected, "gOne"), "for gTwo by A, B, 3 times\nfor gThree by A\n");
    EXPECT_EQ(arrowText(expected, "gFour"), "");
}

TEST(Arrows, stand_between_targets_in_the_order_of_their_first_writing_the_picture_last) {
    SessionFrame frame;
    frame.targets = {"gA", "gB", "gC", "gDepth"};
    frame.passes = {passOf("1", {}, {"gC"}), passOf("2", {"gC"}, {""}), passOf("3", {"gC"}, {"gA"}), passOf("4", {"gA"}, {"gC"})};
    frame.passes[0].targets.emplace_back("gDepth");
    EXPECT_EQ(inOrderOfFlow(frame), (std::vector<std::string>{"gB", "gC", "gDepth", "gA", ""}));
}

TEST(TimesOfPasses, runs_of_one_name_in_a_row_are_one_row) {
    PassTimes times;
    times.note(timed({{"Shadow", 2}, {"Blur", 3}, {"Blur", 4}, {"Final", 5}, {"Blur", 1}}, 0.5));
    ASSERT_EQ(times.passes().size(), 5U);
    EXPECT_EQ(times.passes()[1].runs, 2U);
    EXPECT_EQ(times.passes()[1].milliseconds, 7);
    EXPECT_EQ(times.passes()[4].name, "resolve");
    EXPECT_EQ(times.drawn(), 15.5);
}

TEST(TimesOfPasses, one_frame_out_of_line_moves_the_smoothed_time_by_a_part_and_many_by_all) {
    PassTimes times;
    for (int i = 0; i < 20; ++i)
        times.note(timed({{"Final", 4}}));
    times.note(timed({{"Final", 40}}));
    EXPECT_GT(times.passes()[0].milliseconds, 4);
    EXPECT_LT(times.passes()[0].milliseconds, 22) << "nearer to what twenty frames took";
    for (int i = 0; i < 40; ++i)
        times.note(timed({{"Final", 40}}));
    EXPECT_NEAR(times.passes()[0].milliseconds, 40, 0.1);
}

TEST(TimesOfPasses, what_was_kept_has_its_last_time_and_none_in_the_frame) {
    PassTimes times;
    times.note(timed({{"Shadow", 8}, {"Final", 4}}, 1));
    times.note(timed({{"Shadow", 0}, {"Final", 4}}, 1));
    EXPECT_TRUE(times.passes()[0].kept);
    EXPECT_EQ(times.passes()[0].milliseconds, 8);
    EXPECT_EQ(times.drawn(), 5);
    EXPECT_EQ(times.all(), 13);
}

TEST(TimesOfPasses, a_frame_without_resolve_keeps_what_was_known) {
    PassTimes times;
    times.note(timed({{"Final", 4}}));
    times.note(timed({{"Final", 4}}, 2));
    times.note(timed({{"Final", 4}}));
    ASSERT_EQ(times.passes().size(), 2U);
    EXPECT_TRUE(times.passes()[1].kept);
    EXPECT_EQ(times.passes()[1].milliseconds, 2);
}

TEST(TimesOfPasses, other_passes_begin_anew) {
    PassTimes times;
    times.note(timed({{"A", 1}}));
    times.note(timed({{"B", 3}}));
    ASSERT_EQ(times.passes().size(), 1U);
    EXPECT_EQ(times.passes()[0].milliseconds, 3);
}

TEST(Probe, finds_the_place_on_a_picture_that_is_fitted_into_the_window) {
    // 100 x 50 in 200 x 200: it stands from 50 to 150 of the height.
    const auto middle = placeOnPicture({0.5, 0.5}, {100, 50}, {200, 200});
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->x, 0.5, 1e-12);
    EXPECT_NEAR(middle->y, 0.5, 1e-12);
    const auto top = placeOnPicture({0.25, 0.25}, {100, 50}, {200, 200});
    ASSERT_TRUE(top);
    EXPECT_NEAR(top->x, 0.25, 1e-12);
    EXPECT_NEAR(top->y, 0, 1e-12);
    EXPECT_FALSE(placeOnPicture({0.5, 0.2}, {100, 50}, {200, 200})) << "above it";
    EXPECT_FALSE(placeOnPicture({-0.1, 0.5}, {100, 100}, {200, 200})) << "outside the window";
    EXPECT_FALSE(placeOnPicture({0.5, 0.5}, {0, 50}, {200, 200}));
    EXPECT_FALSE(placeOnPicture({0.5, 0.5}, {100, 50}, {0, 0})) << "an iconified window";
}

TEST(Probe, tells_the_texel_and_its_values_the_shown_target_first) {
    const Image picture = ramp(4, 2, 3);
    const Image depth = ramp(8, 4, 1);
    const auto lines =
        probeLines({probedTexel("", picture, {0.625, 0.5}), probedTexel("gDepth", depth, {0.625, 0.5})}, "gDepth", {0.625, 0.5});
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0], "at 0.6250, 0.5000");
    EXPECT_EQ(lines[1].substr(0, 6), "gDepth");
    EXPECT_NE(lines[1].find("5,   2"), std::string::npos) << lines[1];
    EXPECT_NE(lines[1].find(" 22"), std::string::npos) << lines[1]; // 2 * 8 + 5, counted from 1
    EXPECT_EQ(lines[2].substr(0, 7), "picture");
    EXPECT_NE(lines[2].find("19       20       21"), std::string::npos) << lines[2]; // texel (2, 1): 3 * (4 + 2) + 1
}

TEST(Probe, its_last_texel_is_the_last) {
    const Image picture = ramp(2, 2, 1);
    EXPECT_NE(probeLines({probedTexel("", picture, {1, 1})}, "", {1, 1})[1].find("1,   1"), std::string::npos);
}

TEST(Spread, counts_each_written_texel_once_and_leaves_out_what_is_not_finite) {
    Image image = ramp(8, 8, 1);
    image.pixels[3] = 0; // nothing was drawn there
    image.pixels[5] = std::numeric_limits<float>::quiet_NaN();
    image.pixels[6] = std::numeric_limits<float>::infinity();
    const Histogram histogram = histogramOf(image);
    EXPECT_EQ(histogram.low, 1);
    EXPECT_EQ(histogram.high, 64);
    EXPECT_EQ(histogram.notFinite, 2U);
    EXPECT_EQ(std::accumulate(histogram.counts[0].begin(), histogram.counts[0].end(), std::size_t{0}), 61U);
    EXPECT_EQ(histogram.counts[0].back(), 1U) << "the largest value";
}

TEST(Spread, leaves_alpha_out) {
    const Histogram histogram = histogramOf({.width = 2, .height = 1, .channels = 4, .pixels = {0.1F, 0.2F, 0.3F, 9, 0, 0, 0, 1}});
    EXPECT_EQ(histogram.channels, 3);
    EXPECT_EQ(histogram.low, 0.1F) << "the second texel is not written";
    EXPECT_EQ(histogram.high, 0.3F);
}

TEST(Spread, of_nothing_or_of_one_value_is_fine) {
    EXPECT_EQ(histogramOf({.width = 0, .height = 0, .channels = 3}).high, 0);
    const Histogram one = histogramOf({.width = 2, .height = 1, .channels = 1, .pixels = {7, 7}});
    EXPECT_EQ(one.counts[0][0], 2U);
    EXPECT_EQ(one.low, one.high);
}

TEST(Strip, opens_a_target_or_the_picture_and_nothing_else) {
    ViewState state;
    state.targets = {"gA", "gB"};
    state.stops = 2;
    EXPECT_EQ(showTarget(state, "gB"), Request::Draw);
    EXPECT_EQ(state.show, Show::Target);
    EXPECT_EQ(state.target, "gB");
    EXPECT_EQ(state.stops, 0) << "its own exposure";
    EXPECT_EQ(showTarget(state, "gone"), Request::None);
    EXPECT_EQ(state.target, "gB");
    EXPECT_EQ(showTarget(state, ""), Request::Draw);
    EXPECT_EQ(state.show, Show::Picture);
}

} // namespace tegument::view
