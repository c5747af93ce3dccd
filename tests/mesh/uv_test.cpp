#include "host/mesh/mesh.h"

#include <gtest/gtest.h>

using namespace tegument;

namespace {

/// Rectangles of two triangles each: left, top, width, height.
Mesh rectangles(const std::vector<glm::vec4>& list) {
    Mesh mesh;
    for (const glm::vec4& r : list) {
        const auto i = static_cast<std::uint32_t>(mesh.uvs.size());
        mesh.uvs.insert(mesh.uvs.end(), {{r.x, r.y}, {r.x + r.z, r.y}, {r.x + r.z, r.y + r.w}, {r.x, r.y + r.w}});
        mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + 2, i, i + 2, i + 3});
    }
    return mesh;
}

constexpr double kTexel = 1.0 / 1024;

} // namespace

TEST(UvReport, the_whole_square_is_covered_once) {
    const UvReport report = examineUvs(rectangles({{0, 0, 1, 1}}));
    EXPECT_EQ(report.covered, 1);
    EXPECT_EQ(report.overlapping, 0) << "texels on the diagonal belong to one triangle only";
    EXPECT_EQ(report.outside, 0);
}

TEST(UvReport, shared_edges_never_count_twice_wherever_they_run) {
    // A fan around an odd point: its eight edges cross texel centres at all angles.
    Mesh mesh;
    mesh.uvs = {{0.4137f, 0.5859f}, {0, 0}, {0.5f, 0}, {1, 0}, {1, 0.5f}, {1, 1}, {0.5f, 1}, {0, 1}, {0, 0.5f}};
    for (std::uint32_t i = 1; i <= 8; ++i)
        mesh.indices.insert(mesh.indices.end(), {0, i, i % 8 + 1});
    const UvReport report = examineUvs(mesh);
    EXPECT_EQ(report.overlapping, 0);
    EXPECT_EQ(report.covered, 1);
}

TEST(UvReport, half_overlap_is_half_of_the_area) {
    // two squares of side 0.5, of which half of each is shared
    const UvReport report = examineUvs(rectangles({{0, 0, 0.5f, 0.5f}, {0.25f, 0, 0.5f, 0.5f}}));
    EXPECT_NEAR(report.overlapping, 0.5, 4 * kTexel);
    EXPECT_NEAR(report.covered, 0.375, 2 * kTexel);
}

TEST(UvReport, mirrored_copies_overlap_wholly) {
    Mesh mesh = rectangles({{0.1f, 0.1f, 0.3f, 0.3f}});
    mesh.indices.insert(mesh.indices.end(), {2, 1, 0, 3, 2, 0});
    EXPECT_EQ(examineUvs(mesh).overlapping, 1);
}

TEST(UvReport, outside_is_the_exact_share) {
    EXPECT_NEAR(examineUvs(rectangles({{0.75f, 0, 0.5f, 0.5f}})).outside, 0.5, 1e-6);
    EXPECT_NEAR(examineUvs(rectangles({{-1, -1, 3, 3}})).outside, 8.0 / 9, 1e-6);
    EXPECT_EQ(examineUvs(rectangles({{5, 5, 1, 1}})).outside, 1);
}

TEST(UvReport, enormous_coordinates_are_outside_and_do_not_hang) {
    EXPECT_GT(examineUvs(rectangles({{-1e30f, -1e30f, 3e30f, 3e30f}})).outside, 0.99);
}

TEST(UvReport, ten_thousand_full_squares_take_bounded_time) {
    const UvReport report = examineUvs(rectangles(std::vector<glm::vec4>(10000, glm::vec4(0, 0, 1, 1))));
    EXPECT_EQ(report.overlapping, 1);
}

TEST(UvReport, of_a_mesh_without_uvs_is_all_zero) {
    const UvReport report = examineUvs({});
    EXPECT_EQ(report.covered, 0);
    EXPECT_EQ(report.overlapping, 0);
}
