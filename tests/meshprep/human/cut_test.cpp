#include "meshprep/human/cut.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace tegument {
namespace {

TriangleSurface cubeSurface() {
    const QuadMesh cube = shapes::cube(1);
    TriangleSurface surface{.positions = cube.positions, .normals = {}, .uvs = cube.uvs, .triangles = {}};
    for (const glm::vec3& p : cube.positions)
        surface.normals.push_back(glm::normalize(p));
    for (const Quad& quad : cube.quads)
        for (const auto& [b, c] : {std::pair<std::size_t, std::size_t>(1, 2), std::pair<std::size_t, std::size_t>(2, 3)})
            surface.triangles.push_back(
                {.position = {quad.position[0], quad.position[b], quad.position[c]}, .uv = {quad.uv[0], quad.uv[b], quad.uv[c]}});
    return surface;
}

double areaOf(const TriangleSurface& surface) {
    double area = 0;
    for (const CornerTriangle& t : surface.triangles)
        area += static_cast<double>(glm::length(glm::cross(surface.positions[t.position[1]] - surface.positions[t.position[0]],
                                                           surface.positions[t.position[2]] - surface.positions[t.position[0]]))) /
                2;
    return area;
}

TEST(Cut, what_is_left_has_the_area_above_the_plane) {
    TriangleSurface surface = cubeSurface();
    cutBelow(surface, 0.25f);
    EXPECT_NEAR(areaOf(surface), 4 + 4 * 2 * 0.75, 1e-5); // the top and four sides of height 0.75
}

TEST(Cut, nothing_is_left_below_the_plane) {
    TriangleSurface surface = cubeSurface();
    cutBelow(surface, 0.25f);
    for (const CornerTriangle& t : surface.triangles)
        for (const std::uint32_t v : t.position)
            EXPECT_GE(surface.positions[v].y, 0.25f);
}

TEST(Cut, texture_coordinates_are_cut_at_the_same_place) {
    TriangleSurface surface = cubeSurface();
    for (glm::vec2& uv : surface.uvs)
        uv = glm::vec2(-1);
    for (const CornerTriangle& t : surface.triangles)
        for (std::size_t c = 0; c < 3; ++c)
            surface.uvs[t.uv[c]] = glm::vec2(surface.positions[t.position[c]].x, surface.positions[t.position[c]].y);
    cutBelow(surface, 0.25f);
    for (const CornerTriangle& t : surface.triangles)
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_LT(glm::distance(surface.uvs[t.uv[c]], glm::vec2(surface.positions[t.position[c]])), 1e-6f);
}

TEST(Cut, a_plane_beside_the_mesh_changes_nothing) {
    TriangleSurface surface = cubeSurface();
    cutBelow(surface, -5);
    EXPECT_EQ(surface.triangles.size(), 12u);
}

TEST(Cut, a_vertex_near_the_plane_is_moved_onto_it) {
    TriangleSurface surface = cubeSurface();
    cutBelow(surface, -0.98f);
    EXPECT_EQ(surface.triangles.size(), 10u); // the bottom goes, and no sliver comes
}

TEST(Cut, the_closed_base_leaves_no_open_edge) {
    TriangleSurface surface = cubeSurface();
    cutBelow(surface, 0.25f);
    EXPECT_GT(closeBase(surface, 0.25f), 0u);
    const auto place = [&](std::uint32_t v) {
        const glm::vec3& p = surface.positions[v];
        return std::array<float, 3>{p.x, p.y, p.z};
    };
    std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> balance;
    for (const CornerTriangle& t : surface.triangles)
        for (std::size_t c = 0; c < 3; ++c) {
            ++balance[{place(t.position[c]), place(t.position[(c + 1) % 3])}];
            --balance[{place(t.position[(c + 1) % 3]), place(t.position[c])}];
        }
    for (const auto& [edge, count] : balance)
        EXPECT_EQ(count, 0);
}

TEST(Cut, the_base_faces_down) {
    TriangleSurface surface = cubeSurface();
    cutBelow(surface, 0.25f);
    closeBase(surface, 0.25f);
    for (const CornerTriangle& t : surface.triangles) {
        if (t.part != BustPart::Base) continue;
        const glm::vec3 normal = glm::cross(surface.positions[t.position[1]] - surface.positions[t.position[0]],
                                            surface.positions[t.position[2]] - surface.positions[t.position[0]]);
        EXPECT_LT(normal.y, 0);
    }
}

} // namespace
} // namespace tegument
