#include "meshprep/human/edge_ways.h"
#include "meshprep/human/exterior.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument {
namespace {

TEST(Exterior, every_face_of_a_cube_is_seen) {
    const QuadMesh cube = shapes::cube(1);
    EXPECT_EQ(std::ranges::count(seenFromOutside(cube.positions, cube.quads), 1), 6);
}

TEST(Exterior, a_cube_inside_a_closed_cube_is_not_seen) {
    QuadMesh mesh = shapes::cube(2);
    shapes::append(mesh, shapes::cube(1));
    EXPECT_EQ(seenFromOutside(mesh.positions, mesh.quads), (std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0}));
}

TEST(Exterior, a_cube_inside_an_open_box_is_seen_from_the_opening_only) {
    QuadMesh mesh = shapes::cube(2);
    mesh.quads.erase(mesh.quads.begin() + 3); // the face at +y
    shapes::append(mesh, shapes::cube(1.9f));
    const std::vector<std::uint8_t> seen = seenFromOutside(mesh.positions, mesh.quads);
    EXPECT_EQ(seen[5 + 3], 1); // +y
    EXPECT_EQ(seen[5 + 2], 0); // -y
}

TEST(Exterior, cracks_do_not_open_a_cavity) {
    QuadMesh mesh = shapes::cube(2);
    shapes::append(mesh, shapes::cube(1.9f));
    for (std::uint32_t& corner : mesh.quads[3].position) { // the lid gets corners of its own, moved aside by 0.01
        mesh.positions.push_back(mesh.positions[corner] + glm::vec3(0.01f, 0, 0));
        corner = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    }
    const std::vector<std::uint8_t> seen = seenFromOutside(mesh.positions, mesh.quads);
    EXPECT_EQ(std::ranges::count(seen.begin() + 6, seen.end(), 1), 0);
}

/// A row of quads of which the first is seen.
std::vector<std::uint8_t> hiddenInRow(std::size_t leastPatch, float rim) {
    QuadMesh row;
    for (std::uint32_t x = 0; x <= 10; ++x) {
        row.positions.emplace_back(x, 0, 0);
        row.positions.emplace_back(x, 1, 0);
    }
    for (std::uint32_t x = 0; x < 10; ++x)
        row.quads.push_back({.position = {2 * x, 2 * x + 2, 2 * x + 3, 2 * x + 1}, .uv = {}});
    std::vector<std::uint8_t> seen(10, 0);
    seen[0] = 1;
    return hiddenPatches(row.positions, row.quads, seen, leastPatch, rim);
}

TEST(Exterior, a_rim_of_hidden_faces_stays_beside_the_seen_ones) {
    EXPECT_EQ(hiddenInRow(1, 2.5f), (std::vector<std::uint8_t>{0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
}

TEST(Exterior, small_hidden_patches_stay) {
    EXPECT_EQ(std::ranges::count(hiddenInRow(10, 0.5f), 1), 0);
}

TEST(EdgeWays, lengths_run_along_edges) {
    const QuadMesh grid = shapes::grid(3);
    const EdgeWays ways = waysAlongEdges(grid.positions, grid.quads, {0}, 100);
    EXPECT_FLOAT_EQ(ways.length[15], 6); // three to the right, three up: no diagonal
}

TEST(EdgeWays, every_vertex_knows_its_nearest_source) {
    const QuadMesh grid = shapes::grid(3);
    const EdgeWays ways = waysAlongEdges(grid.positions, grid.quads, {0, 15}, 100);
    EXPECT_EQ(ways.source[1], 0u);
    EXPECT_EQ(ways.source[14], 15u);
}

} // namespace
} // namespace tegument
