#include "meshprep/human/subdivide.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument {
namespace {

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
