// The level that a viewer draws while something moves.

#include "meshprep/prepare/levels.h"
#include "tests/run/sphere.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

namespace tegument::prep {

namespace {

using Place = std::tuple<int, int, int>; // hundredths of a millimetre: vertices on both sides of a seam differ in their last bits

Place placeAt(const glm::vec3& p) {
    const auto round = [](float x) { return static_cast<int>(std::lround(100 * x)); };
    return {round(p.x), round(p.y), round(p.z)};
}

/// Edges that are not met by one the other way round; triangles without area have none.
std::size_t openEdges(const Mesh& mesh, const std::vector<std::uint32_t>& corners) {
    std::map<std::pair<Place, Place>, int> edges;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        const Place p[] = {placeAt(mesh.positions[corners[i]]), placeAt(mesh.positions[corners[i + 1]]),
                           placeAt(mesh.positions[corners[i + 2]])};
        if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
        for (int k = 0; k < 3; ++k) {
            ++edges[{p[k], p[(k + 1) % 3]}];
            --edges[{p[(k + 1) % 3], p[k]}];
        }
    }
    return static_cast<std::size_t>(std::ranges::count_if(edges, [](const auto& edge) { return edge.second != 0; }));
}

double areaOf(const Mesh& mesh, const std::vector<std::uint32_t>& corners) {
    double area = 0;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        const glm::dvec3 a = mesh.positions[corners[i]];
        area +=
            0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions[corners[i + 1]]) - a, glm::dvec3(mesh.positions[corners[i + 2]]) - a));
    }
    return area;
}

} // namespace

TEST(QuickLevel, has_about_so_many_triangles_no_hole_at_a_seam_and_nearly_the_same_surface) {
    const Mesh mesh = test::sphere();
    ASSERT_EQ(openEdges(mesh, mesh.indices), 0U);
    const std::vector<std::uint32_t> level = quickLevel(mesh, 500);
    EXPECT_LE(level.size() / 3, 600U) << "of " << mesh.indices.size() / 3;
    EXPECT_GT(level.size() / 3, 300U);
    EXPECT_EQ(openEdges(mesh, level), 0U);
    const double whole = areaOf(mesh, mesh.indices);
    EXPECT_NEAR(areaOf(mesh, level), whole, 0.05 * whole) << "a sphere of 500 triangles in even shapes loses 1.5 %";
}

} // namespace tegument::prep
