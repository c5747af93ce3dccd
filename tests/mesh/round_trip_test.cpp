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

TEST_F(RoundTrip, clusters_of_a_part_return_and_know_where_they_are) {
    Mesh mesh = sheet();
    mesh.parts[1].clusters = {{.firstIndex = 0, .indexCount = 99}, {.firstIndex = 99, .indexCount = mesh.parts[1].indexCount - 99}};
    computeClusters(mesh, mesh.parts[1]);
    ASSERT_TRUE(writeGlb(folder_ / "a.glb", mesh));
    const auto read = loadMesh(folder_ / "a.glb");
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_TRUE(read->parts[0].clusters.empty());
    ASSERT_EQ(read->parts[1].clusters.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        const MeshCluster& written = mesh.parts[1].clusters[i];
        const MeshCluster& found = read->parts[1].clusters[i];
        EXPECT_EQ(found.firstIndex, written.firstIndex);
        EXPECT_EQ(found.indexCount, written.indexCount);
        EXPECT_EQ(found.centre, written.centre);
        EXPECT_EQ(found.radius, written.radius);
        EXPECT_EQ(found.axis, written.axis);
        EXPECT_EQ(found.cosine, written.cosine);
    }
}

// The file's own balls and cones are for other readers: wrong ones would make ours leave out what can be seen.
TEST_F(RoundTrip, balls_of_clusters_are_not_believed) {
    Mesh mesh = sheet();
    mesh.parts[0].clusters = {{.firstIndex = 0, .indexCount = 300, .centre = {900, 0, 0}, .radius = 0.1F, .cosine = 1}};
    ASSERT_TRUE(writeGlb(folder_ / "a.glb", mesh));
    const auto read = loadMesh(folder_ / "a.glb");
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_LT(glm::length(read->parts[0].clusters[0].centre), 300);
    EXPECT_GT(read->parts[0].clusters[0].radius, 50);
}

TEST_F(RoundTrip, clusters_that_do_not_fill_their_part_are_refused) {
    const std::vector<std::vector<std::uint32_t>> wrong = {{299}, {297}, {150, 153}, {0, 300}, {600}, {300, 3}};
    for (const auto& counts : wrong) {
        Mesh mesh = sheet();
        for (const std::uint32_t count : counts)
            mesh.parts[0].clusters.push_back({.indexCount = count});
        ASSERT_TRUE(writeGlb(folder_ / "a.glb", mesh));
        const auto read = loadMesh(folder_ / "a.glb");
        ASSERT_FALSE(read) << counts.front();
        EXPECT_EQ(read.error().diagnostics.front().code, 5302) << format(read.error());
        EXPECT_NE(format(read.error()).find("clusters"), std::string::npos) << format(read.error());
    }
}

TEST_F(RoundTrip, parts_that_a_shader_expands_are_no_overlap_of_texture_coordinates) {
    Mesh mesh = sheet();
    const std::vector<std::uint32_t> again(mesh.indices.begin(), mesh.indices.begin() + 300);
    mesh.parts.push_back({.name = "more", .firstIndex = static_cast<std::uint32_t>(mesh.indices.size()), .indexCount = 300});
    mesh.indices.insert(mesh.indices.end(), again.begin(), again.end());
    EXPECT_GT(examineUvs(mesh).overlapping, 0.1);
    mesh.parts.back().expanded = true;
    EXPECT_LT(examineUvs(mesh).overlapping, 0.1);
}
