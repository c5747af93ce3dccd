// Density, length and direction from the vertices of a mesh file.
#include "meshprep/fur/roots/roots.h"
#include "meshprep/fur/roots/vertex_maps.h"
#include "tests/fur/roots/built.h"
#include "tests/fur/roots/meshes.h"

#include "host/support/file.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <unistd.h>

using namespace tegument;
namespace fs = std::filesystem;

namespace {

/// A strip of 10 x 2 squares of side 10, each of whose vertices has what `values` writes of its x.
class VertexMaps : public testing::Test {
protected:
    void SetUp() override {
        path_ = fs::temp_directory_path() / ("tegument-vertex-maps-" + std::to_string(::getpid()) + "-" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name() + ".ply");
    }
    void TearDown() override { fs::remove(path_); }

    Mesh strip(const std::string& properties, const std::function<std::string(int)>& values) {
        std::string text = "ply\nformat ascii 1.0\nelement vertex 33\nproperty float x\n" + properties +
                           "property float y\nproperty float z\nelement face 20\nproperty list uchar int vertex_indices\nend_header\n";
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 11; ++i)
                text += std::to_string(10 * i) + " " + values(i) + " " + std::to_string(10 * j) + " 0\n";
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 10; ++i) {
                const int a = 11 * j + i;
                text += "4 " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + 12) + " " +
                        std::to_string(a + 11) + "\n";
            }
        return load(text);
    }

    Mesh load(const std::string& text) {
        EXPECT_TRUE(writeFile(path_, text));
        auto mesh = loadMesh(path_);
        if (mesh) return *std::move(mesh);
        ADD_FAILURE() << format(mesh.error());
        return {};
    }

    [[nodiscard]] FurMap shares(const Mesh& mesh, const std::string& name) const {
        auto map = readVertexShares(path_, name, mesh);
        if (map) return *std::move(map);
        ADD_FAILURE() << format(map.error());
        return FurMap(std::vector<glm::dvec3>(mesh.positions.size()));
    }

    static void expectError(const Result<FurMap>& result, int code, const std::string& part) {
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().diagnostics.front().code, code);
        EXPECT_NE(format(result.error()).find(part), std::string::npos) << format(result.error());
    }

    fs::path path_;
};

std::string number(double value) {
    return std::to_string(value);
}

} // namespace

TEST_F(VertexMaps, thin_the_fur_out_by_a_property_with_a_point) {
    const Mesh mesh = strip("property float quality\n", [](int i) { return number(0.1 * i); });
    const RootSet set = rootsOf(mesh, {.count = 4000, .densityMap = shares(mesh, "quality")});
    EXPECT_NEAR(static_cast<double>(set.roots.size()), 2000, 20) << "the mean of the ramp is a half";
    for (int part = 0; part < 4; ++part) {
        const auto count = std::ranges::count_if(set.roots, [&](const Root& r) {
            return r.position.x >= 25.0F * static_cast<float>(part) && r.position.x < 25.0F * static_cast<float>(part + 1);
        });
        // a quarter's mean is (2 part + 1) / 8; places vary less than independent ones, whose five sigma these are
        EXPECT_NEAR(static_cast<double>(count), 1000 * (2 * part + 1) / 8.0, 5 * std::sqrt(1000 * (2 * part + 1) / 8.0)) << part;
    }
}

TEST_F(VertexMaps, take_255_of_a_byte_and_65535_of_two_for_1) {
    const Mesh mesh = strip("property uchar red\nproperty ushort wide\n",
                            [](int i) { return std::to_string(i > 0 ? 255 : 51) + " " + std::to_string(i > 0 ? 65535 : 13107); });
    for (const char* name : {"red", "wide"})
        for (const Root& root : rootsOf(mesh, {.count = 2000, .shortest = 1, .lengthMap = shares(mesh, name)}).roots)
            EXPECT_NEAR(root.share, std::min(1.0, 0.2 + 0.08 * static_cast<double>(root.position.x)), 1e-4);
}

TEST_F(VertexMaps, lean_strands_along_a_vector_in_mesh_space) {
    const Mesh mesh = strip("property float vx\nproperty float vy\nproperty double vz\n", [](int) { return "-0.6 0.8 5"; });
    const auto map = readVertexDirections(path_, "vx, vy,vz", mesh);
    ASSERT_TRUE(map) << format(map.error());
    for (const Root& root : rootsOf(mesh, {.count = 100, .lean = 0.5, .directionMap = *map}).roots)
        EXPECT_LT(glm::distance(root.lean, glm::vec3(-0.3F, 0.4F, 0)), 1e-5F) << "without what points out of the surface";
}

TEST_F(VertexMaps, read_directions_from_colours_as_from_maps) {
    const Mesh mesh = strip("property uchar red\nproperty uchar green\nproperty uchar blue\n", [](int) { return "255 128 128"; });
    const auto map = readVertexDirections(path_, "red,green,blue", mesh);
    ASSERT_TRUE(map) << format(map.error());
    for (const Root& root : rootsOf(mesh, {.count = 100, .lean = 1, .directionMap = *map}).roots)
        EXPECT_LT(glm::distance(root.lean, glm::vec3(1, 0, 0)), 0.005F) << "128 is 0.502, half a step off the middle";
}

TEST_F(VertexMaps, belong_to_the_same_vertices_when_the_reader_has_left_some_out) {
    const Mesh mesh = load("ply\nformat ascii 1.0\nelement face 2\nproperty list uchar int vertex_indices\n"
                           "element vertex 5\nproperty float x\nproperty float y\nproperty float z\nproperty float d\nend_header\n"
                           "3 1 2 3\n3 3 3 1\n7 7 7 0.9\n0 0 0 0.25\n100 0 0 0.25\n0 100 0 0.25\n9 9 9 0.8\n");
    EXPECT_EQ(mesh.positions.size(), 3u);
    for (const Root& root : rootsOf(mesh, {.count = 100, .shortest = 1, .lengthMap = shares(mesh, "d")}).roots)
        EXPECT_NEAR(root.share, 0.25, 1e-6);
}

TEST_F(VertexMaps, are_the_mean_where_vertices_share_a_place) {
    const Mesh mesh =
        load("ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\nproperty float d\n"
             "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
             "0 0 0 0\n100 0 0 0\n0 100 0 0\n0 0 0 1\n0 100 -0 1\n-100 0 0 1\n3 0 1 2\n3 3 4 5\n");
    const FurMap map = shares(mesh, "d");
    const FurSurface surface(mesh);
    EXPECT_NEAR(shareAt(map, surface, surface.at(0, {0, 0})), 0.5, 1e-9);
    EXPECT_NEAR(shareAt(map, surface, surface.at(0, {1, 0})), 0, 1e-9);
    EXPECT_NEAR(shareAt(map, surface, surface.at(1, {0, 1})), 1, 1e-9);
}

TEST_F(VertexMaps, list_the_names_there_are_when_one_is_unknown) {
    const Mesh mesh = strip("property float quality\nproperty list uchar int ring\n", [](int) { return "1 0"; });
    expectError(readVertexShares(path_, "density", mesh), 5313, "x, quality, y, z");
    expectError(readVertexShares(path_, "ring", mesh), 5313, "no property 'ring'");
    expectError(readVertexDirections(path_, "x,y,w", mesh), 5313, "'w'");
}

TEST_F(VertexMaps, refuse_what_is_no_share) {
    const Mesh mesh = strip("property float quality\nproperty int level\n", [](int i) { return number(i - 3) + " " + std::to_string(i); });
    expectError(readVertexShares(path_, "quality", mesh), 7108, "vertex 0 has quality -3, which is no share");
    expectError(readVertexShares(path_, "quality", mesh), 7108, "between -3 and 7");
    expectError(readVertexShares(path_, "level", mesh), 7108, "between 0 and 10");
}

TEST_F(VertexMaps, refuse_what_is_not_finite) {
    const Mesh mesh = strip("property float a\nproperty float b\n", [](int i) { return i == 7 ? "nan inf" : "0 0"; });
    expectError(readVertexShares(path_, "a", mesh), 7108, "vertex 7");
    expectError(readVertexShares(path_, "b", mesh), 7108, "not finite");
    expectError(readVertexDirections(path_, "a,x,y", mesh), 7108, "not finite");
}

TEST_F(VertexMaps, need_three_names_for_a_direction) {
    const Mesh mesh = strip("property float a\n", [](int) { return "0"; });
    for (const char* names : {"x", "x,y", "x,y,z,a", ""})
        expectError(readVertexDirections(path_, names, mesh), 7103, "for a direction");
    expectError(readVertexDirections(path_, "x,,z", mesh), 5313, "no property ''");
}

TEST_F(VertexMaps, come_from_ply_only) {
    path_.replace_extension(".obj");
    const Mesh mesh = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expectError(readVertexShares(path_, "quality", mesh), 5313, "only PLY");
}
