// Every technique of every effect, found in the files: the same scene put otherwise gives the same picture (docs/design/invariance.md).

#include "host/effect/model.h"
#include "host/image/compare.h"
#include "host/support/file.h"
#include "lab/invariance/cases.h"
#include "lab/invariance/invariance.h"
#include "lab/invariance/painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <set>

using namespace tegument;
using namespace tegument::invariance;

namespace {

namespace fs = std::filesystem;

/// Without validation layers, which would double the time: tests/run and tests/cli have the same passes under them.
gpu::Device* device(std::string& reason) {
    static Result<gpu::Device> made = gpu::Device::create();
    if (made) return &*made;
    reason = format(made.error());
    return nullptr;
}

class Invariance : public testing::Test {
protected:
    void SetUp() override {
        std::string reason;
        device_ = device(reason);
        if (!device_) GTEST_SKIP() << reason;
    }

    [[nodiscard]] std::vector<InvarianceCell> measure(const fs::path& effect, InvarianceOptions options) {
        options.compiler = defaultCompiler();
        auto cells = measureInvariance(*device_, effect, options);
        EXPECT_TRUE(cells) << format(cells.error());
        return cells ? *std::move(cells) : std::vector<InvarianceCell>();
    }

    gpu::Device* device_ = nullptr;
};

class EveryEffect : public Invariance, public testing::WithParamInterface<fs::path> {};

/// One picture of a scene with a mistake in it, held against the right one.
class Mistakes : public Invariance {
protected:
    [[nodiscard]] double difference(const fs::path& file, const std::string& technique, const EngineScene& wrong) {
        return difference(file, technique, wrong, scene_);
    }

    [[nodiscard]] double difference(const fs::path& file, const std::string& technique, const EngineScene& wrong,
                                    const EngineScene& asItIs) {
        std::vector<std::pair<std::string, std::string>> defines{{"TEGUMENT_MAP_SIZE", "192"}};
        if (asItIs.workspace.parameters.contains("gLampPlace")) std::ranges::copy(lampDefines(), std::back_inserter(defines));
        const auto effect = loadEffect(file, {.defines = defines});
        EXPECT_TRUE(effect) << format(effect.error());
        const RunOptions run{.technique = technique, .width = 192, .height = 192, .compiler = defaultCompiler()};
        Painter painter(*device_, *effect, run);
        const auto right = painter.draw(asItIs);
        const auto picture = painter.draw(wrong);
        EXPECT_TRUE(right && picture);
        const auto compared = compareImages(*picture, *right);
        EXPECT_TRUE(compared) << format(compared.error());
        return compared->relativeL2;
    }

    const EngineScene scene_{.mesh = invarianceMesh(), .workspace = invarianceWorkspace()};
};

/// A third of all, with the hardest of each column; all of them take minutes for an effect of fur.
std::vector<std::string> casesOfEachKind() {
    return {"mesh in inches",
            "world matrix scales by 0.001",
            "world matrix scales by 3.000",
            "world and mesh in metres",
            "world in metres, mesh in millimetres",
            "world_unit_mm of the workspace is 10",
            "everything times 25.40",
            "scene turned, 1",
            "mesh with odd axes",
            "scene moved far",
            "mesh with its origin elsewhere",
            "mesh mirrored, and back",
            "scene in a mirror",
            "triangles and vertices shuffled",
            "each draw in two",
            "values by --set",
            "in inches in a world of metres, turned, moved",
            "the same under parallel light",
            "several lights: mesh in inches",
            "several lights: world and mesh in metres",
            "several lights: scene in a mirror",
            "several lights: each draw in two",
            "several lights: in inches in a world of metres, turned, moved"};
}

std::string message(const InvarianceCell& cell) {
    return invarianceMarkdown({cell});
}

std::string testName(const testing::TestParamInfo<fs::path>& each) {
    return each.param.stem().string();
}

} // namespace

INSTANTIATE_TEST_SUITE_P(Effects, EveryEffect, testing::ValuesIn(effectFiles("effects")), testName);

TEST_P(EveryEffect, looks_the_same_however_its_scene_is_put) {
    const auto effect = loadEffect(GetParam());
    ASSERT_TRUE(effect) << format(effect.error());
    ASSERT_FALSE(effect->techniques.empty());
    const std::vector<std::string> cases = std::getenv("TEGUMENT_EVERY_CASE") ? invarianceCases() : casesOfEachKind();
    const auto cells = measure(GetParam(), {.cases = cases});
    for (const InvarianceCell& cell : cells)
        EXPECT_TRUE(cell.pass()) << message(cell);
    for (const Technique& technique : effect->techniques)
        for (const std::string& name : cases)
            EXPECT_EQ(
                std::ranges::count_if(cells, [&](const InvarianceCell& c) { return c.technique == technique.name && c.name == name; }), 1)
                << technique.name << ", " << name;
}

TEST_F(Invariance, no_effect_of_the_library_is_left_out) {
    std::set<std::string> found;
    for (const fs::path& file : effectFiles("effects"))
        found.insert(file.generic_string());
    std::size_t there = 0;
    for (const auto& entry : fs::recursive_directory_iterator("effects"))
        if (entry.path().extension() == ".fx") {
            EXPECT_TRUE(found.contains(entry.path().generic_string())) << entry.path();
            ++there;
        }
    EXPECT_EQ(found.size(), there);
}

TEST(InvarianceTable, shows_the_largest_of_a_column_and_names_what_is_beyond_its_limit) {
    const InvarianceCell good{.effect = "A.fx", .technique = "A", .column = "unit", .name = "in metres", .relativeL2 = 2e-4, .limit = 1e-3};
    InvarianceCell bad = good;
    bad.name = "in inches";
    bad.relativeL2 = 0.5;
    EXPECT_TRUE(good.pass());
    EXPECT_FALSE(bad.pass());
    EXPECT_NE(invarianceMarkdown({good}).find("| A | 2.0e-04 |"), std::string::npos);
    const std::string both = invarianceMarkdown({good, bad});
    EXPECT_NE(both.find("| A | **5.0e-01** |"), std::string::npos) << both;
    EXPECT_NE(both.find("* in inches: 5.0e-01"), std::string::npos) << both;
    InvarianceCell lost = good;
    lost.error = inputError(4040, {}, "no mesh");
    EXPECT_FALSE(lost.pass());
    EXPECT_NE(invarianceMarkdown({lost}).find("**error**"), std::string::npos);
    InvarianceCell nothing = good;
    nothing.relativeL2 = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(nothing.pass());
}

TEST(InvarianceExceptions, are_at_most_three_each_with_its_cause) {
    const std::vector<std::string> columns = invarianceColumns();
    EXPECT_LE(invarianceExceptions().size(), 3U);
    for (const InvarianceException& exception : invarianceExceptions()) {
        EXPECT_NE(std::ranges::find(columns, exception.column), columns.end()) << exception.column;
        EXPECT_TRUE(fs::exists("effects/" + exception.effect + ".fx")) << exception.effect;
        EXPECT_GT(exception.cause.size(), 20U) << exception.effect;
    }
}

TEST_F(Invariance, the_causes_of_the_exceptions_are_layers_over_layers) {
    // A coat of one layer has nothing to be blended over but skin: then neither order nor the number of draws matters.
    const Mesh mesh = invarianceMesh();
    Workspace workspace = invarianceWorkspace();
    workspace.parameters["gFurLayers"] = {1};
    for (const InvarianceException& exception : invarianceExceptions()) {
        const auto cells =
            measure("effects/" + exception.effect + ".fx", {.cases = {exception.column}, .mesh = &mesh, .workspace = &workspace});
        EXPECT_FALSE(cells.empty());
        for (const InvarianceCell& cell : cells)
            EXPECT_LT(cell.relativeL2, 1e-3) << message(cell);
    }
}

TEST_F(Invariance, the_default_head_in_metres_under_a_world_matrix_that_scales_by_1000_is_the_head_in_millimetres) {
    const fs::path file = cacheFolder() / "human" / "human.glb";
    if (!fs::exists(file)) GTEST_SKIP() << "no " << file << ": tegument prep human makes it";
    const auto workspace = loadWorkspace("effects/workspaces/human.json");
    ASSERT_TRUE(workspace) << format(workspace.error());
    const auto mesh = loadMesh(workspace->meshPath, meshOptions(*workspace));
    ASSERT_TRUE(mesh) << format(mesh.error());
    const InvarianceOptions options{.cases = {"mesh in metres"}, .mesh = &*mesh, .workspace = &*workspace};
    for (const char* effect : {"effects/Main.fx", "effects/Specular.fx"}) {
        const auto cells = measure(effect, options);
        EXPECT_FALSE(cells.empty());
        for (const InvarianceCell& cell : cells)
            EXPECT_TRUE(cell.pass()) << message(cell);
    }
}

// The scene shows what could be wrong: the same mistakes in it, which an engine or a shader may make, are far beyond the limits.

TEST_F(Mistakes, a_world_in_metres_that_does_not_say_so_is_another_picture) {
    EngineScene scene = scene_;
    changeWorldUnit(scene, 1000);
    scene.workspace.parameters.erase("gUnitMm");
    EXPECT_GT(difference("effects/Main.fx", "DEonLuebke", scene), 0.1);
}

TEST_F(Mistakes, a_mirrored_mesh_whose_bitangents_are_not_turned_is_another_picture) {
    EngineScene scene = scene_;
    mirrorMesh(scene);
    for (glm::vec4& tangent : scene.mesh.tangents)
        tangent.w = -tangent.w;
    EXPECT_GT(difference("effects/Specular.fx", "SpecularUnshadowed", scene), 0.02);
}

TEST_F(Mistakes, a_light_that_is_not_turned_along_is_another_picture) {
    EngineScene scene = scene_;
    const Light before = scene.workspace.light;
    turnWorldAndAim(scene, {0, 10, 0});
    scene.workspace.light = before;
    EXPECT_GT(difference("effects/ShadowMap.fx", "Shadow", scene), 0.02);
}

TEST_F(Mistakes, lamps_that_stand_still_while_the_scene_turns_are_another_picture) {
    EngineScene lit = scene_;
    addLamps(lit);
    EngineScene turned = lit;
    turnWorld(turned, {0, 10, 0}, glm::vec3(0));
    EXPECT_LT(difference("effects/Main.fx", "Lambert", turned, lit), 1e-3) << "as it should be";
    turned.workspace.parameters["gLampPlace"] = lit.workspace.parameters["gLampPlace"];
    EXPECT_GT(difference("effects/Main.fx", "Lambert", turned, lit), 0.02);
}

TEST_F(Mistakes, vertices_shuffled_without_their_texture_coordinates_are_another_picture) {
    EngineScene scene = scene_;
    const std::vector<glm::vec2> uvs = scene.mesh.uvs;
    shuffle(scene);
    scene.mesh.uvs = uvs;
    EXPECT_GT(difference("effects/OriginalTexture.fx", "OriginalTexture", scene), 0.1);
}

TEST_F(Mistakes, half_a_mesh_is_another_picture) {
    EngineScene scene = scene_;
    scene.mesh.indices.resize(scene.mesh.indices.size() / 6 * 3);
    EXPECT_GT(difference("effects/OriginalTexture.fx", "OriginalTexture", scene), 0.1);
}
