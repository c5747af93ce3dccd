// What becomes of files that are dropped on the window.
#include "tools/cli/dropped.h"

#include <gtest/gtest.h>

using namespace tegument;
using namespace tegument::app;

namespace {

const Effect& mainEffect() {
    static const auto kEffect = loadEffect("effects/Main.fx");
    EXPECT_TRUE(kEffect);
    return *kEffect;
}

JobOptions after(const JobOptions& options, const std::string& file) {
    const auto next = withDropped(options, file, mainEffect());
    EXPECT_TRUE(next) << format(next.error());
    return next ? *next : JobOptions{};
}

} // namespace

TEST(Dropped, a_mesh_takes_the_place_of_the_scene) {
    JobOptions options;
    options.scene.workspace = "human";
    options.scene.unitMm = 25.4;
    options.sets = {"gRoughness=0.5"};
    const JobOptions next = after(options, "/tmp/Scan.PLY");
    EXPECT_EQ(next.scene.mesh, "/tmp/Scan.PLY");
    EXPECT_EQ(next.scene.workspace, "") << "its camera looks at another mesh";
    EXPECT_FALSE(next.scene.unitMm);
    EXPECT_EQ(next.sets, options.sets);
}

TEST(Dropped, a_workspace_brings_its_own_mesh) {
    JobOptions options;
    options.scene.mesh = "scan.ply";
    const JobOptions next = after(options, "mine.json");
    EXPECT_EQ(next.scene.workspace, "mine.json");
    EXPECT_EQ(next.scene.mesh, "");
}

TEST(Dropped, an_effect_keeps_the_scene_and_no_values_of_the_other) {
    JobOptions options;
    options.file = "Main";
    options.technique = "Gosselin";
    options.preset = "oily";
    options.sets = {"gRoughness=0.5"};
    options.scene.mesh = "scan.ply";
    const JobOptions next = after(options, "Mine.fx");
    EXPECT_EQ(next.file, "Mine.fx");
    EXPECT_EQ(next.technique + next.preset, "");
    EXPECT_TRUE(next.sets.empty());
    EXPECT_EQ(next.scene.mesh, "scan.ply");
}

TEST(Dropped, a_texture_goes_to_the_parameter_that_its_name_speaks_of) {
    const auto setOf = [](const std::string& file) { return after({}, file).sets.back(); };
    EXPECT_EQ(setOf("head_normals.png"), "gNormalMap=head_normals.png");
    EXPECT_EQ(setOf("Head-NRM.exr"), "gNormalMap=Head-NRM.exr");
    EXPECT_EQ(setOf("kernel_size.exr"), "gKernelSizeMap=kernel_size.exr");
    EXPECT_EQ(setOf("Stretch.dds"), "gStretchMap=Stretch.dds");
    EXPECT_EQ(setOf("IMG_0001.JPG"), "gSkinMap=IMG_0001.JPG") << "a photograph is the colour map";
    JobOptions twice = after({}, "a.png");
    twice = after(twice, "b.png");
    EXPECT_EQ(twice.sets, std::vector<std::string>{"gSkinMap=b.png"});
}

TEST(Dropped, what_is_nothing_of_these_is_refused) {
    for (const char* file : {"notes.txt", "archive.zip", "noending"}) {
        const auto next = withDropped({}, file, mainEffect());
        ASSERT_FALSE(next) << file;
        EXPECT_EQ(next.error().diagnostics.front().code, 8045);
    }
    const auto beckmann = loadEffect("effects/Beckmann.fx");
    ASSERT_TRUE(beckmann);
    EXPECT_FALSE(withDropped({}, "a.png", *beckmann)) << "it takes no textures";
}
