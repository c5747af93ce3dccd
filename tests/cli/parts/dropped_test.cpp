// What becomes of files that are dropped on the window.
// The presets that come along.
// How far the work is, and when it will be done.
// What lies beside links: whose mesh they were made for.

#include "host/effect/model.h"
#include "host/scene/presets.h"
#include "host/support/file.h"
#include "meshprep/assets/cached_links.h"
#include "tools/cli/dropped.h"
#include "tools/cli/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace tegument;
using namespace tegument::app;
using tegument::app::durationText;
using tegument::app::Estimate;

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

/// Three faces that meet at right angles, `height` high.
Mesh corner(float height) {
    Mesh mesh;
    mesh.name = "corner";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, height}};
    mesh.indices = {0, 2, 1, 0, 1, 3, 0, 3, 2};
    mesh.bounds.radius = height; // of some ball: all is counted in it
    return mesh;
}

struct Links {
    std::filesystem::path folder = std::filesystem::temp_directory_path() / ("skin_links_" + std::to_string(::getpid()));
    std::filesystem::path file = folder / "links.dds";

    Links() { std::filesystem::create_directories(folder); }
    ~Links() { std::filesystem::remove_all(folder); }
    Links(const Links&) = delete;
    Links& operator=(const Links&) = delete;

    void beside(const std::string& json) const { ASSERT_TRUE(writeFile(folder / "links.json", json)); }
};

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

TEST(Dropped, a_workspace_is_drawn_as_it_says) {
    const Links files; // a folder
    const std::string file = (files.folder / "mine.json").string();
    ASSERT_TRUE(writeFile(file, R"({"technique": "Lambert", "size": [40, 30], "samples": 2, "parameters": {"TEGUMENT_LAMPS": 2}})"));
    JobOptions options;
    options.technique = "Gosselin";
    options.effect.setting = "seed";
    options.size = "900x900";
    options.samples = 4;
    options.sets = {"TEGUMENT_LAMPS=1", "TEGUMENT_LOBES=1", "gRoughness=0.5"};
    const JobOptions next = after(options, file);
    EXPECT_EQ(next.technique + next.size, "");
    EXPECT_EQ(next.samples, 0);
    EXPECT_EQ(next.effect.setting, "seed") << "it says none";
    EXPECT_EQ(next.sets, (std::vector<std::string>{"TEGUMENT_LOBES=1", "gRoughness=0.5"}));
}

TEST(Dropped, an_effect_keeps_the_scene_and_no_values_of_the_other) {
    JobOptions options;
    options.file = "Main";
    options.technique = "Gosselin";
    options.preset = "oily";
    options.sets = {"gRoughness=0.5", "TEGUMENT_LAMPS=1"};
    options.scene.mesh = "scan.ply";
    const JobOptions next = after(options, "Mine.fx");
    EXPECT_EQ(next.file, "Mine.fx");
    EXPECT_EQ(next.technique + next.preset, "");
    EXPECT_EQ(next.sets, std::vector<std::string>{"TEGUMENT_LAMPS=1"}) << "a switch of all";
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

TEST(OwnPresets, lie_within_the_ranges_and_differ_from_the_defaults) {
    // Of skin three looks and six skins; where melanin and blood give any, three more.
    for (const auto& [name, count] : {std::pair("effects/Main.fx", 9U), std::pair("effects/Pyramid.fx", 12U),
                                      std::pair("effects/Fur.fx", 3U), std::pair("effects/FurRoots.fx", 3U)}) {
        const auto effect = tegument::loadEffect(name);
        const auto presets = tegument::loadPresets(name);
        ASSERT_TRUE(effect && presets) << name;
        EXPECT_EQ(presets->size(), count) << name;
        for (const tegument::Preset& preset : *presets) {
            EXPECT_FALSE(preset.comment.empty()) << preset.name;
            bool differs = false;
            for (const auto& [parameter, value] : preset.parameters) {
                const tegument::Parameter* found = effect->findParameter(parameter);
                ASSERT_TRUE(found) << name << " " << preset.name << " " << parameter;
                const auto least = found->annotations.numbers("UIMin");
                const auto most = found->annotations.numbers("UIMax");
                for (const double number : value) {
                    EXPECT_TRUE(!least || number >= least->front()) << preset.name << " " << parameter;
                    EXPECT_TRUE(!most || number <= most->front()) << preset.name << " " << parameter;
                }
                const auto* usual = found->defaultValue ? std::get_if<std::vector<double>>(&*found->defaultValue) : nullptr;
                differs = differs || !usual || *usual != value;
            }
            EXPECT_TRUE(differs) << preset.name;
        }
    }
}

TEST(Estimate, of_a_count_is_what_the_items_so_far_took) {
    Estimate estimate;
    estimate.say("frame 1 of 11", 10);
    EXPECT_FALSE(estimate.left(10)) << "nothing is done yet";
    estimate.say("frame 3 of 11", 14);
    EXPECT_NEAR(*estimate.left(14), 16, 1e-9) << "2 s each, 8 to come";
    estimate.say("frame 11 of 11", 30);
    EXPECT_NEAR(*estimate.left(30), 0, 1e-9);
}

TEST(Estimate, begins_anew_where_another_count_begins) {
    Estimate estimate;
    estimate.say("reference: pixel 0 of 100", 0);
    estimate.say("reference: pixel 90 of 100", 90);
    estimate.say("preparing Main (1 of 3)", 100);
    EXPECT_FALSE(estimate.left(101)) << "what the reference took says nothing of it";
    estimate.say("preparing Main (2 of 3)", 104);
    EXPECT_NEAR(*estimate.left(104), 4, 1e-9);
    estimate.say("preparing Main (1 of 3)", 110);
    EXPECT_FALSE(estimate.left(110)) << "the next round";
}

TEST(Estimate, of_expected_steps_is_of_all_of_them) {
    Estimate estimate;
    estimate.expect({{"mesh", 1}, {"maps", 3}, {"write", 1}});
    estimate.say("mesh", 2);
    EXPECT_FALSE(estimate.left(3));
    estimate.say("maps of 2048 texels", 4);
    EXPECT_NEAR(*estimate.left(4), 8, 1e-9) << "1 of 5 took 2 s";
    estimate.count(1, 3, 6); // a loop within the step
    EXPECT_NEAR(*estimate.left(6), 6, 1e-9) << "2 of 5 took 4 s";
    estimate.say("write", 10);
    EXPECT_NEAR(*estimate.left(10), 2, 1e-9);
}

TEST(Estimate, is_said_once_it_is_worth_saying) {
    Estimate estimate;
    estimate.say("drawing the cube map", 0);
    EXPECT_EQ(estimate.line(1), "drawing the cube map");
    EXPECT_EQ(estimate.line(12), "drawing the cube map, 12 s");
    estimate.count(1, 5, 12);
    estimate.count(2, 5, 14);
    EXPECT_EQ(estimate.line(14), "drawing the cube map, 40 %, 14 s, about 6 s left");
    estimate.say("compiling shader 3 of 19", 20);
    EXPECT_EQ(estimate.line(20), "compiling shader 3 of 19");
}

TEST(Estimate, takes_no_other_numbers_for_a_count) {
    Estimate estimate;
    for (const char* text : {"step 5 of", "of 7", "7 of many", "9 of 3", "0 of 0"}) {
        estimate.say(text, 0);
        estimate.say(text, 5);
        EXPECT_FALSE(estimate.left(6)) << text;
    }
}

TEST(Durations, are_read_at_a_glance) {
    EXPECT_EQ(durationText(0.4), "0 s");
    EXPECT_EQ(durationText(59.4), "59 s");
    EXPECT_EQ(durationText(61), "1 min 01 s");
    EXPECT_EQ(durationText(3599.6), "60 min 00 s");
}

TEST(SkinLinksFile, of_another_mesh_is_refused_and_of_the_same_taken) {
    const Links links;
    SkinLinks made{.sheet = {.width = 4, .height = 4, .pixels = std::vector<float>(64)}};
    ASSERT_TRUE(assets::writeSkinLinks(links.file, corner(1), made, {}));
    EXPECT_TRUE(assets::checkSkinLinks(links.file, corner(1)));
    const auto other = assets::checkSkinLinks(links.file, corner(3));
    ASSERT_FALSE(other);
    const std::string said = format(other.error());
    for (const char* text : {"TG4055", "another mesh than corner"})
        EXPECT_NE(said.find(text), std::string::npos) << said;
}

TEST(SkinLinksFile, with_any_json_beside_it_is_taken_as_it_is) {
    const Links links;
    const std::string head = R"({"kind": "tegument skin links", "mesh": )";
    for (const std::string& text :
         {std::string(), std::string("[1]"), std::string(R"({"kind": 3})"), std::string(R"({"kind": {"a": 1}})"), head + "7}",
          head + "[{}]}", head + R"({"surface": "no"}})", head + R"({"surface": {"area": "1", "middle": [0,0,0], "spread": [0,0,0]}}})",
          head + R"({"surface": {"area": 1, "middle": {"x": 1}, "spread": [0,0,0]}}})",
          head + R"({"surface": {"area": 1, "middle": [0,0], "spread": [0,null,0]}}})", head + std::string(100000, '[')}) {
        links.beside(text);
        EXPECT_TRUE(assets::checkSkinLinks(links.file, corner(1))) << text.substr(0, 120);
    }
}
