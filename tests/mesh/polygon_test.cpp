// Polygons that are not convex, through a reader that takes any: each is cut inside its outline.
#include "tests/mesh/files.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

using namespace tegument;
using namespace tegument::testing_scene;

namespace {

using Polygon = SceneFiles;

std::string plyOf(const std::vector<glm::dvec3>& outline) {
    std::string text = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
                                   "element face 1\nproperty list uint uint vertex_indices\nend_header\n",
                                   outline.size());
    for (const glm::dvec3& p : outline)
        text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
    text += std::to_string(outline.size());
    for (std::size_t i = 0; i < outline.size(); ++i)
        text += " " + std::to_string(i);
    return text + "\n";
}

/// By Green's theorem, in the plane with this normal.
double areaOf(const std::vector<glm::dvec3>& outline, const glm::dvec3& normal) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < outline.size(); ++i)
        sum += glm::cross(outline[i], outline[(i + 1) % outline.size()]);
    return glm::dot(sum, normal) / 2;
}

/// No triangle is turned over, and together they have the outline's area: so they fill it without overlap.
void expectFilled(const Mesh& mesh, const std::vector<glm::dvec3>& outline, const glm::dvec3& normal) {
    EXPECT_EQ(mesh.indices.size() / 3, outline.size() - 2);
    double area = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto p = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
        const double own = glm::dot(glm::cross(p(1) - p(0), p(2) - p(0)), normal) / 2;
        EXPECT_GE(own, -1e-5) << "triangle " << i / 3;
        area += own;
    }
    EXPECT_NEAR(area, areaOf(outline, normal), 1e-4);
}

std::vector<glm::dvec3> comb(int teeth) {
    std::vector<glm::dvec3> outline = {{0, 0, 0}, {2.0 * teeth, 0, 0}};
    for (int i = teeth; i > 0; --i) {
        outline.emplace_back(2.0 * i, 3, 0);
        outline.emplace_back(2.0 * i - 1, 1, 0);
    }
    outline.emplace_back(0, 3, 0);
    return outline;
}

} // namespace

TEST_F(Polygon, a_comb_is_filled_without_overlap) {
    const auto outline = comb(9);
    const auto mesh = load("a.ply", plyOf(outline));
    ASSERT_TRUE(mesh) << format(mesh.error());
    expectFilled(*mesh, outline, {0, 0, 1});
}

TEST_F(Polygon, a_star_in_a_tilted_plane_is_filled_without_overlap) {
    std::vector<glm::dvec3> outline;
    const glm::dvec3 u = glm::normalize(glm::dvec3(1, 2, 3));
    const glm::dvec3 v = glm::normalize(glm::cross(u, glm::dvec3(0, 1, 0)));
    for (int i = 0; i < 24; ++i) {
        const double angle = std::numbers::pi * i / 12;
        const double radius = i % 2 == 0 ? 3 : 1;
        outline.push_back(radius * (std::cos(angle) * u + std::sin(angle) * v) + glm::dvec3(5, 6, 7));
    }
    const auto mesh = load("a.ply", plyOf(outline));
    ASSERT_TRUE(mesh) << format(mesh.error());
    expectFilled(*mesh, outline, glm::cross(u, v));
}

TEST_F(Polygon, a_clockwise_comb_keeps_its_side) {
    auto outline = comb(4);
    std::reverse(outline.begin(), outline.end());
    const auto mesh = load("a.ply", plyOf(outline));
    ASSERT_TRUE(mesh) << format(mesh.error());
    expectFilled(*mesh, outline, {0, 0, -1});
}

TEST_F(Polygon, a_ring_with_a_slit_is_filled_around_its_hole) {
    const std::vector<glm::dvec3> outline = {{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, {0, 0, 0},
                                             {2, 2, 0}, {2, 4, 0}, {4, 4, 0}, {4, 2, 0}, {2, 2, 0}};
    const auto mesh = load("a.ply", plyOf(outline));
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_NEAR(areaOf(outline, {0, 0, 1}), 32, 1e-9);
    expectFilled(*mesh, outline, {0, 0, 1});
}

TEST_F(Polygon, one_that_crosses_itself_ends_with_as_many_triangles) {
    const auto mesh = load("a.ply", plyOf({{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}, {2, 6, 0}, {3, -2, 0}}));
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices.size() / 3, 4u);
}

TEST_F(Polygon, a_concave_one_of_more_than_ten_thousand_corners_is_refused) {
    EXPECT_EQ(codeOf(load("a.ply", plyOf(comb(5000)))), 5307);
}

TEST_F(Polygon, a_convex_one_of_many_corners_is_read) {
    std::vector<glm::dvec3> circle;
    for (int i = 0; i < 20000; ++i)
        circle.emplace_back(1000 * std::cos(2 * std::numbers::pi * i / 20000), 1000 * std::sin(2 * std::numbers::pi * i / 20000), 0);
    const auto mesh = load("a.ply", plyOf(circle));
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices.size() / 3, 19998u);
}
