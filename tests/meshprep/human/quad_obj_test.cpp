#include "meshprep/human/atlas.h"
#include "meshprep/human/quad_mesh.h"
#include "meshprep/human/subdivide.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument {
namespace {

constexpr std::string_view kTwoGroups = "# two faces that share an edge\n"
                                        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
                                        "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.25\n"
                                        "g left\nf 1/1 2/2 3/3 4/4\n"
                                        "g right\r\nf 2/1 5/2 6/3 3/5\n";

int codeOf(const Result<QuadMesh>& result) {
    return result ? 0 : result.error().diagnostics.front().code;
}
int lineOf(const Result<QuadMesh>& result) {
    return result ? 0 : result.error().diagnostics.front().at.line;
}

TEST(QuadObj, groups_keep_their_faces) {
    const Result<QuadMesh> mesh = readQuadObj(kTwoGroups, "a.obj", 1);
    ASSERT_TRUE(mesh) << format(mesh.error());
    ASSERT_EQ(mesh->groups.size(), 2u);
    EXPECT_EQ(mesh->groups[1].name, "right");
    EXPECT_EQ(mesh->groups[1].first, 1u);
    EXPECT_EQ(mesh->groups[1].count, 1u);
}

TEST(QuadObj, corners_keep_position_and_texture_apart) {
    const Result<QuadMesh> mesh = readQuadObj(kTwoGroups, "a.obj", 1);
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->quads[1].position, (std::array<std::uint32_t, 4>{1, 4, 5, 2}));
    EXPECT_EQ(mesh->quads[1].uv, (std::array<std::uint32_t, 4>{0, 1, 2, 4}));
}

TEST(QuadObj, positions_are_scaled_to_millimetres_and_coordinates_are_not) {
    const Result<QuadMesh> mesh = readQuadObj(kTwoGroups, "a.obj", 100);
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->positions[4], glm::vec3(200, 0, 0));
    EXPECT_EQ(mesh->uvs[4], glm::vec2(0.5f, 0.25f));
}

TEST(QuadObj, a_group_that_recurs_is_gathered) {
    const Result<QuadMesh> mesh = readQuadObj(std::string(kTwoGroups) + "g left\nf 2/1 5/2 6/3 3/4\n", "a.obj", 1);
    ASSERT_TRUE(mesh);
    const Result<std::vector<Quad>> left = quadsOfGroup(*mesh, "left", "a.obj");
    ASSERT_TRUE(left);
    EXPECT_EQ(left->size(), 2u);
}

TEST(QuadObj, an_unknown_group_names_the_nearest) {
    const Result<QuadMesh> mesh = readQuadObj(kTwoGroups, "a.obj", 1);
    ASSERT_TRUE(mesh);
    const Result<std::vector<Quad>> quads = quadsOfGroup(*mesh, "rigth", "a.obj");
    ASSERT_FALSE(quads);
    EXPECT_EQ(format(quads.error()), "a.obj: error TG7004: there is no face in a group 'rigth'; did you mean 'right'?");
}

TEST(QuadObj, a_damaged_number_is_an_error_with_its_line) {
    const Result<QuadMesh> mesh = readQuadObj("v 0 0 0\nv 1 zwei 0\n", "a.obj", 1);
    EXPECT_EQ(codeOf(mesh), 5302);
    EXPECT_EQ(lineOf(mesh), 2);
}

TEST(QuadObj, a_number_that_is_not_finite_is_an_error) {
    EXPECT_EQ(codeOf(readQuadObj("v 0 0 inf\n", "a.obj", 1)), 5305);
    EXPECT_EQ(codeOf(readQuadObj("vt 0 nan\n", "a.obj", 1)), 7001);
}

TEST(QuadObj, a_line_that_breaks_off_is_an_error) {
    EXPECT_EQ(codeOf(readQuadObj("v 0 0", "a.obj", 1)), 5302);
}

TEST(QuadObj, a_triangle_is_an_error) {
    EXPECT_EQ(codeOf(readQuadObj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n", "a.obj", 1)), 7002);
}

TEST(QuadObj, a_face_that_is_no_quad_is_named_by_its_line) {
    EXPECT_EQ(lineOf(readQuadObj(std::string(kTwoGroups) + "f 1/1 2/2 3/3 4/4 5/5\n", "a.obj", 1)), 17);
}

TEST(QuadObj, a_face_without_texture_coordinates_is_an_error) {
    EXPECT_EQ(codeOf(readQuadObj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", "a.obj", 1)), 7002);
}

TEST(QuadObj, an_index_beyond_the_vertices_is_an_error) {
    EXPECT_EQ(codeOf(readQuadObj("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1/1 2/1 3/1 4/1\n", "a.obj", 1)), 5304);
}

TEST(QuadObj, index_zero_is_an_error) {
    EXPECT_EQ(codeOf(readQuadObj("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 0/1 1/1 2/1 3/1\n", "a.obj", 1)), 5304);
}

TEST(QuadObj, an_empty_text_is_an_empty_mesh) {
    const Result<QuadMesh> mesh = readQuadObj("", "a.obj", 1);
    ASSERT_TRUE(mesh);
    EXPECT_TRUE(mesh->quads.empty());
}

TEST(Charts, faces_that_share_a_coordinate_are_one_chart) {
    const std::vector<Quad> quads = {{.uv = {0, 1, 2, 3}}, {.uv = {6, 7, 8, 9}}, {.uv = {3, 4, 5, 2}}};
    EXPECT_EQ(chartsOf(quads), (std::vector<std::uint32_t>{0, 1, 0}));
}

float nearest(const std::vector<glm::vec3>& points, const glm::vec3& p) {
    float result = 1e9f;
    for (const glm::vec3& q : points)
        result = std::min(result, glm::distance(p, q));
    return result;
}

// M. Halstead, M. Kass, T. DeRose, Efficient, Fair Interpolation using Catmull-Clark Surfaces, 1993: the limit of a vertex with n faces is
// (n^2 v + 4 sum of edge neighbours + sum of face neighbours) / (n (n + 5)). Corner of a cube with half edge 1: (9 + 4 - 1) / 24 = 1/2.
TEST(Subdivide, corners_of_a_cube_lie_on_the_limit_surface) {
    const QuadMesh cube = shapes::cube(1);
    const Result<Subdivided> fine = subdivide(cube.positions, cube.uvs, cube.quads, 2);
    ASSERT_TRUE(fine);
    EXPECT_LT(nearest(fine->positions, glm::vec3(0.5f)), 1e-6f); // a few roundings of single precision
}

TEST(Subdivide, normals_of_a_closed_surface_point_outwards) {
    const QuadMesh cube = shapes::cube(1);
    const Result<Subdivided> fine = subdivide(cube.positions, cube.uvs, cube.quads, 2);
    ASSERT_TRUE(fine);
    for (std::size_t v = 0; v < fine->positions.size(); ++v)
        EXPECT_GT(glm::dot(fine->normals[v], glm::normalize(fine->positions[v])), 0.9f); // a rounded cube turns less than 25 degrees off
}

TEST(Subdivide, every_quad_has_four_children_per_level) {
    const QuadMesh cube = shapes::cube(1);
    const Result<Subdivided> fine = subdivide(cube.positions, cube.uvs, cube.quads, 2);
    ASSERT_TRUE(fine);
    for (std::uint32_t parent = 0; parent < 6; ++parent)
        EXPECT_EQ(std::ranges::count(fine->parents, parent), 16) << "quad " << parent;
}

TEST(Subdivide, charts_stay_apart) {
    const QuadMesh cube = shapes::cube(1);
    const Result<Subdivided> fine = subdivide(cube.positions, cube.uvs, cube.quads, 2);
    ASSERT_TRUE(fine);
    EXPECT_EQ(fine->uvs.size(), 6u * 25u); // five by five coordinates for each face, none shared
}

TEST(Subdivide, texture_coordinates_follow_the_surface_on_a_flat_grid) {
    const QuadMesh grid = shapes::grid(4);
    const Result<Subdivided> fine = subdivide(grid.positions, grid.uvs, grid.quads, 2);
    ASSERT_TRUE(fine);
    for (const Quad& quad : fine->quads)
        for (std::size_t c = 0; c < 4; ++c) {
            const glm::vec3& p = fine->positions[quad.position[c]];
            // Positions are limits, coordinates are not: both are linear only away from the border.
            if (p.x <= 1 || p.y <= 1 || p.x >= 3 || p.y >= 3) continue;
            EXPECT_LT(glm::distance(glm::vec2(p), fine->uvs[quad.uv[c]]), 1e-5f);
        }
}

TEST(Subdivide, the_border_of_an_open_mesh_keeps_its_place) {
    const QuadMesh grid = shapes::grid(3);
    const Result<Subdivided> fine = subdivide(grid.positions, grid.uvs, grid.quads, 2);
    ASSERT_TRUE(fine);
    for (const glm::vec3& corner : {glm::vec3(0), glm::vec3(3, 0, 0), glm::vec3(3, 3, 0), glm::vec3(0, 3, 0)})
        EXPECT_LT(nearest(fine->positions, corner), 1e-6f);
    for (const glm::vec3& p : fine->positions)
        EXPECT_TRUE(p.x >= -1e-6f && p.x <= 3 + 1e-6f && p.z == 0);
}

} // namespace
} // namespace tegument
