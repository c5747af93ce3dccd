// Maps that shape fur, on a plate with texture coordinates and on a ball without.
// Density, length and direction from the vertices of a mesh file.
// The roots' texture, read as a shader reads it, against all roots one by one.

#include "host/support/file.h"
#include "meshprep/fur/roots/root_maps.h"
#include "meshprep/fur/roots/root_texture.h"
#include "meshprep/fur/roots/roots.h"
#include "meshprep/fur/roots/scatter.h"
#include "tests/fur/roots/built.h"
#include "tests/fur/roots/meshes.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

using namespace tegument;
using namespace tegument::testing_roots;
namespace fs = std::filesystem;

namespace {

/// Two texels side by side.
FurMap halves(const glm::vec3& left, const glm::vec3& right) {
    Image image{.width = 2, .height = 1, .channels = 3, .pixels = {left.x, left.y, left.z, right.x, right.y, right.z}};
    return FurMap(DdsTexture{.images = {image}});
}

/// A cube map of one colour a face.
FurMap faces(const std::array<glm::vec3, 6>& colours) {
    DdsTexture texture{.faces = 6};
    for (const glm::vec3& c : colours)
        texture.images.push_back({.width = 1, .height = 1, .channels = 3, .pixels = {c.x, c.y, c.z}});
    return FurMap(std::move(texture));
}

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

class RootTextures : public testing::TestWithParam<double> {};

} // namespace

TEST(RootMaps, thin_the_fur_out_where_the_density_is_less) {
    // A map of two texels is a ramp between their centres and repeats at the borders: at 1/4 it is 1, at 3/4 it is 0.25, in the middle
    // 0.625.
    const RootSet set = rootsOf(plate(), {.count = 8000, .densityMap = halves(glm::vec3(1), glm::vec3(0.25))});
    EXPECT_NEAR(static_cast<double>(set.wanted), 8000 * 0.625, 8000 * 0.01);
    EXPECT_EQ(set.roots.size(), set.wanted);
    const auto between = [&](double from, double to) {
        return static_cast<double>(std::ranges::count_if(
            set.roots, [&](const Root& root) { return root.position.x >= 100 * from && root.position.x < 100 * to; }));
    };
    // the ramp's mean over a fifth round its ends: 1 - 0.05 * 1.5 = 0.925 and 0.325; five sigma of independent places
    EXPECT_NEAR(between(0.15, 0.35), 1600 * 0.925, 5 * std::sqrt(1600 * 0.925));
    EXPECT_NEAR(between(0.65, 0.85), 1600 * 0.325, 5 * std::sqrt(1600 * 0.325));
}

TEST(RootMaps, scale_lengths_and_leave_bald_what_has_none) {
    const RootSet set = rootsOf(plate(), {.count = 4000, .shortest = 1, .lengthMap = halves(glm::vec3(0.5F), glm::vec3(0))});
    EXPECT_LT(set.roots.size(), 4000u);
    for (const Root& root : set.roots) {
        const double u = static_cast<double>(root.position.x) / 100;
        const double ramp = u < 0.25 ? 0.25 + u : u < 0.75 ? 0.75 - u : u - 0.75; // bilinear, repeating
        EXPECT_NEAR(root.share, ramp, 1e-4) << u;
    }
}

TEST(RootMaps, lean_strands_in_tangent_space) {
    const RootSet set = rootsOf(plate(), {.count = 100, .lean = 0.5, .directionMap = halves({1, 0.5F, 1}, {1, 0.5F, 1})});
    for (const Root& root : set.roots)
        EXPECT_LT(glm::distance(root.lean, glm::vec3(0.5F, 0, 0)), 1e-5F)
            << "along the tangent; what points out of the surface is left out";
    const RootSet up = rootsOf(plate(), {.count = 100, .lean = 0.5, .directionMap = halves({0.5F, 1, 0.5F}, {0.5F, 1, 0.5F})});
    for (const Root& root : up.roots)
        EXPECT_LT(glm::distance(root.lean, glm::vec3(0, 0.5F, 0)), 1e-5F) << "+Y of a normal map: the bitangent, decreasing v";
}

TEST(RootMaps, as_cube_maps_need_no_texture_coordinates) {
    std::array<glm::vec3, 6> density;
    density.fill(glm::vec3(0));
    density[2] = glm::vec3(1); // +Y
    const RootSet set = rootsOf(ball(50), {.count = 6000, .densityMap = faces(density)});
    EXPECT_NEAR(static_cast<double>(set.roots.size()), 1000, 40) << "a face is a sixth of the sphere";
    for (const Root& root : set.roots)
        EXPECT_GE(root.normal.y, std::max(std::abs(root.normal.x), std::abs(root.normal.z)) - 1e-3F);
}

TEST(RootMaps, that_are_flat_need_texture_coordinates) {
    const auto set = makeRoots(ball(50), {.count = 100, .lengthMap = halves(glm::vec3(1), glm::vec3(1))});
    ASSERT_FALSE(set);
    EXPECT_EQ(set.error().diagnostics.front().code, 7106);
}

TEST(RootMaps, that_are_black_everywhere_leave_no_root) {
    const auto set = makeRoots(plate(), {.count = 100, .densityMap = halves(glm::vec3(0), glm::vec3(0))});
    ASSERT_TRUE(set);
    EXPECT_TRUE(set->roots.empty());
}

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

INSTANTIATE_TEST_SUITE_P(Reaches, RootTextures, testing::Values(0.3, 0.5, 1.5),
                         [](const auto& p) { return std::to_string(static_cast<int>(10 * p.param)); });

TEST_P(RootTextures, list_every_root_within_reach_of_any_place_of_the_surface) {
    const Built built = build(ball(50), {.count = 2000, .reach = GetParam()});
    const FurSurface surface(built.mesh);
    std::size_t within = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const glm::vec3 place = surface.toMesh(surface.point(rootNoise(i, 7)).position);
        const auto listed = rootsAround(built.texture.image, place);
        const std::set<std::size_t> found(listed.begin(), listed.end());
        EXPECT_EQ(found.size(), listed.size()) << "each once";
        for (std::size_t k = 0; k < built.set.roots.size(); ++k) {
            const double distance = glm::distance(glm::dvec3(built.set.roots[k].position), glm::dvec3(place));
            within += distance <= built.set.reach;
            const double farthest = built.set.reach + std::sqrt(3.0) * built.set.cell + 1e-3; // from the other end of the cell
            EXPECT_TRUE(found.contains(k) ? distance <= farthest : distance > built.set.reach) << "root " << k << " at " << distance;
        }
    }
    // pi reach^2 roots per place in units of the spacing: the test has looked at what it is about
    EXPECT_NEAR(static_cast<double>(within) / 2000, std::numbers::pi * GetParam() * GetParam(),
                0.1 * std::numbers::pi * GetParam() * GetParam());
}

TEST(RootTexture, has_no_list_longer_than_its_header_says) {
    const Built built = build(ball(50), {.count = 3000});
    const FurSurface surface(built.mesh);
    const float* header = &built.texture.image.pixels[4 * 2];
    std::size_t most = 0;
    for (std::uint64_t i = 0; i < 20000; ++i)
        most = std::max(most, rootsAround(built.texture.image, surface.toMesh(surface.point(rootNoise(i, 9)).position)).size());
    EXPECT_LE(most, 4 * static_cast<std::size_t>(header[3]));
    EXPECT_EQ(built.texture.mostTexels, static_cast<std::size_t>(header[3]));
    EXPECT_EQ(built.texture.mostTexels, (built.texture.mostListed + 3) / 4);
}

TEST(RootTexture, holds_each_root_as_it_is) {
    const Built built = build(ball(50), {.count = 1000, .lean = 0.7, .comb = {1, 0, 0}});
    for (std::size_t i = 0; i < built.set.roots.size(); ++i) {
        const Root& root = built.set.roots[i];
        const Root read = rootAt(built.texture.image, i);
        EXPECT_EQ(read.position, root.position);
        EXPECT_EQ(read.radius, root.radius);
        EXPECT_EQ(read.limit, root.limit);
        EXPECT_EQ(read.random, root.random);
        EXPECT_NEAR(read.share, root.share, 1e-6); // packed into a length: a few roundings
        EXPECT_NEAR(read.curl, root.curl, 1e-6);
        EXPECT_LT(glm::distance(read.normal, root.normal), 1e-6F);
        EXPECT_LT(glm::distance(read.lean, root.lean), 1e-6F);
    }
}

TEST(RootTexture, keeps_the_texels_of_a_root_in_one_row) {
    const Built built = build(ball(50), {.count = 3000}); // more than the 1,365 of one row
    const auto first = static_cast<std::size_t>(built.texture.image.at(6, 0, 0));
    EXPECT_EQ(first % kRootColumns, 0u);
    std::set<std::size_t> addresses;
    for (const Root& root : built.set.roots)
        for (std::size_t i = first; i + 2 < built.texture.texels; ++i)
            if (built.texture.image.pixels[4 * i] == root.position.x && built.texture.image.pixels[4 * i + 3] == root.radius)
                addresses.insert(i);
    EXPECT_EQ(addresses.size(), 3000u);
    for (const std::size_t address : addresses)
        EXPECT_LE(address % kRootColumns, kRootColumns - kRootTexels);
}

TEST(RootTexture, tells_in_its_first_row_what_is_in_it) {
    const Built built = build(ball(50), {.count = 1000, .shortest = 0.5, .lean = 0.4});
    const auto texel = [&](std::size_t i) {
        return glm::vec4(built.texture.image.at(static_cast<int>(i), 0, 0), built.texture.image.at(static_cast<int>(i), 0, 1),
                         built.texture.image.at(static_cast<int>(i), 0, 2), built.texture.image.at(static_cast<int>(i), 0, 3));
    };
    EXPECT_FLOAT_EQ(texel(0).w, static_cast<float>(built.set.cell));
    EXPECT_EQ(texel(2).x, static_cast<float>(built.texture.image.height));
    EXPECT_EQ(texel(2).z, 1000);
    EXPECT_FLOAT_EQ(texel(3).x, static_cast<float>(built.set.reach));
    EXPECT_FLOAT_EQ(texel(3).w, static_cast<float>(1000 / built.set.area));
    EXPECT_NEAR(texel(4).w, 50, 1e-3);
    EXPECT_NEAR(texel(5).x, 0.5, 0.01) << "the least of a thousand shares between 0.5 and 1";
    EXPECT_NEAR(texel(5).y, 0.75, 0.03);
    EXPECT_NEAR(texel(5).z, 0.4, 0.01) << "round the equator strands lean as far as asked for";
}

TEST(RootTexture, has_nothing_outside_of_its_grid) {
    const Built built = build(ball(50), {.count = 1000});
    for (const glm::vec3& place : {glm::vec3(1000, 0, 0), glm::vec3(0, -1000, 0), glm::vec3(0, 0, 1e30F), glm::vec3(0)})
        EXPECT_TRUE(rootsAround(built.texture.image, place).empty());
}

TEST(RootTexture, takes_larger_bricks_where_parts_are_far_apart) {
    Mesh mesh = ball(1, 16);
    Mesh far = ball(1, 16);
    const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::size_t i = 0; i < far.positions.size(); ++i) {
        mesh.positions.push_back(far.positions[i] + 150.0F);
        mesh.normals.push_back(far.normals[i]);
    }
    for (const std::uint32_t index : far.indices)
        mesh.indices.push_back(index + shift);
    const Built built = build(finished(std::move(mesh)), {.count = 2000});
    EXPECT_GT(built.texture.brick, 4);
    for (std::size_t i = 0; i < built.set.roots.size(); ++i) {
        const auto found = rootsAround(built.texture.image, built.set.roots[i].position);
        EXPECT_TRUE(std::ranges::count(found, i) == 1) << i;
    }
}

TEST(RootTexture, that_would_be_too_large_is_refused) {
    const Mesh mesh = ball(50);
    auto many = makeRoots(mesh, {.count = 40'000, .spacing = 0.1, .radius = 0.2, .reach = 4, .cell = 0.25});
    ASSERT_TRUE(many);
    const auto texture = buildRootTexture(*many);
    ASSERT_FALSE(texture);
    EXPECT_EQ(texture.error().diagnostics.front().code, 7107);

    Mesh apart = ball(1, 16);
    for (std::size_t i = apart.positions.size() / 2; i < apart.positions.size(); ++i)
        apart.positions[i] += 1.0F; // a tear; and one triangle a million radii away
    apart.positions.insert(apart.positions.end(), {{1e6F, 1e6F, 1e6F}, {1e6F + 1, 1e6F, 1e6F}, {1e6F, 1e6F + 1, 1e6F}});
    apart.normals.insert(apart.normals.end(), 3, glm::vec3(0, 0, 1));
    const auto n = static_cast<std::uint32_t>(apart.positions.size());
    apart.indices.insert(apart.indices.end(), {n - 3, n - 2, n - 1});
    auto far = makeRoots(finished(std::move(apart)), {.count = 5000, .spacing = 0.1});
    ASSERT_TRUE(far) << format(far.error());
    const auto sparse = buildRootTexture(*far);
    ASSERT_FALSE(sparse);
    EXPECT_EQ(sparse.error().diagnostics.front().code, 7107);
}
