#include "tests/mesh/files.h"

#include <random>

using namespace tegument;
using namespace tegument::testing_scene;

namespace {

using RoundTrip = SceneFiles;

/// A bumpy sheet with two parts, every float of it "random", with normals and tangents made.
Mesh sheet() {
    Mesh mesh;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> jitter(-0.3f, 0.3f);
    constexpr std::uint32_t kSide = 12;
    for (std::uint32_t y = 0; y < kSide; ++y)
        for (std::uint32_t x = 0; x < kSide; ++x) {
            const glm::vec2 at(x, y);
            mesh.positions.push_back(glm::vec3(at + jitter(random), jitter(random)) * 17.3f);
            mesh.uvs.push_back((at + 0.5f) / static_cast<float>(kSide));
        }
    for (std::uint32_t y = 0; y + 1 < kSide; ++y)
        for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
            const std::uint32_t i = y * kSide + x;
            mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + kSide, i + 1, i + kSide + 1, i + kSide});
        }
    const auto count = static_cast<std::uint32_t>(mesh.indices.size());
    mesh.parts = {{"skin", 0, 300}, {"eye \"left\"", 300, count - 300}};
    mesh.name = "sheet";
    mesh.attribution = "Someone, CC BY";
    computeNormals(mesh);
    computeTangents(mesh);
    computeBounds(mesh);
    return mesh;
}

Image checker() {
    Image image{.width = 3, .height = 2, .channels = 3, .pixels = {}, .bitsPerChannel = 8, .metadata = {}};
    for (int i = 0; i < 18; ++i)
        image.pixels.push_back(static_cast<float>(i * 13 % 256) / 255.0f);
    return image;
}

} // namespace

TEST_F(RoundTrip, a_glb_returns_every_float_index_part_texture_and_name) {
    Mesh mesh = sheet();
    for (const char* role : {"color", "normal", "kernelSize"})
        mesh.textures.push_back({.role = role, .image = checker()});
    ASSERT_TRUE(writeGlb(folder_ / "a.glb", mesh));
    const auto read = loadMesh(folder_ / "a.glb");
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_EQ(read->positions, mesh.positions);
    EXPECT_EQ(read->normals, mesh.normals);
    EXPECT_EQ(read->tangents, mesh.tangents);
    EXPECT_EQ(read->uvs, mesh.uvs);
    EXPECT_EQ(read->indices, mesh.indices);
    EXPECT_EQ(read->name, mesh.name);
    EXPECT_EQ(read->attribution, mesh.attribution);
    EXPECT_EQ(read->bounds.radius, mesh.bounds.radius);
    ASSERT_EQ(read->parts.size(), 2u);
    EXPECT_EQ(read->parts[1].name, mesh.parts[1].name);
    EXPECT_EQ(read->parts[1].firstIndex, 300u);
    ASSERT_EQ(read->textures.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(read->textures[i].role, mesh.textures[i].role);
        EXPECT_EQ(read->textures[i].image.pixels, mesh.textures[i].image.pixels);
    }
    EXPECT_TRUE(read->warnings.empty()) << format(read->warnings.front());
}

TEST_F(RoundTrip, the_file_is_in_metres_for_other_programs) {
    Mesh mesh = sheet();
    ASSERT_TRUE(writeGlb(folder_ / "a.glb", mesh));
    const auto metres = loadMesh(folder_ / "a.glb", {.unitMm = 1});
    ASSERT_TRUE(metres);
    EXPECT_FLOAT_EQ(metres->bounds.radius, mesh.bounds.radius / 1000);
}

TEST_F(RoundTrip, a_mesh_without_uvs_stays_without) {
    Mesh mesh = sheet();
    mesh.uvs.clear();
    mesh.tangents.clear();
    ASSERT_TRUE(writeGlb(folder_ / "a.glb", mesh));
    const auto read = loadMesh(folder_ / "a.glb");
    ASSERT_TRUE(read);
    EXPECT_TRUE(read->uvs.empty());
    EXPECT_TRUE(read->tangents.empty());
}

TEST_F(RoundTrip, a_folder_that_cannot_be_written_is_the_machines_fault) {
    const auto written = writeGlb("/proc/nowhere/a.glb", sheet());
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().blame, Blame::Machine);
}
