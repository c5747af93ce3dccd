// The arrows between targets, from effects as they are read and planned, without a GPU; and from passes written by hand.

#include "tools/view/graph.h"

#include "host/adopt/adopt.h"
#include "host/effect/load.h"
#include "host/run/describe.h"

#include <gtest/gtest.h>

#include <algorithm>

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

} // namespace tegument::view
