// Meshes that face the wrong way are told: nothing else says why a picture is bald and dark.
// Polygons that are not convex, through a reader that takes any: each is cut inside its outline.

#include "host/mesh/facing.h"
#include "host/mesh/mesh.h"
#include "host/mesh/welding.h"
#include "tests/mesh/files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace tegument;
using namespace tegument::testing_scene;

namespace {

Bounds boundsOf(std::vector<glm::vec3> points) {
    Mesh mesh;
    mesh.positions = std::move(points);
    computeBounds(mesh);
    return mesh.bounds;
}

std::vector<glm::vec3> randomPoints(std::size_t count, unsigned seed, bool onSphere) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    std::vector<glm::vec3> points(count);
    for (glm::vec3& point : points) {
        point = {normal(random), normal(random), normal(random)};
        if (onSphere) point = glm::normalize(point);
    }
    return points;
}

double farthest(const std::vector<glm::vec3>& points, const Bounds& bounds) {
    double radius = 0;
    for (const glm::vec3& point : points)
        radius = std::max(radius, glm::distance(glm::dvec3(point), glm::dvec3(bounds.centre)));
    return radius;
}

using FacingFiles = SceneFiles;

constexpr const char* kCorners = "v 0 0 0\nv 90 0 0\nv 90 90 0\nv 0 90 0\nv 0 0 90\nv 90 0 90\nv 90 90 90\nv 0 90 90\n";
constexpr const char* kOutwards = "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
constexpr const char* kInwards = "f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n";
constexpr const char* kMixed = "f 4 3 2 1\nf 8 7 6 5\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

int codeAmong(const Result<Mesh>& mesh) {
    EXPECT_TRUE(mesh);
    for (const Diagnostic& warning : mesh ? mesh->warnings : std::vector<Diagnostic>{})
        if (warning.code >= 5332 && warning.code <= 5334) return warning.code;
    return 0;
}

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

TEST(BoundingSphere, known_bodies_have_their_known_radius) {
    std::vector<glm::vec3> cube;
    for (int i = 0; i < 8; ++i)
        cube.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    const Bounds bounds = boundsOf(cube);
    EXPECT_NEAR(bounds.radius, std::sqrt(3.0) / 2, 1e-6);
    EXPECT_LT(glm::distance(bounds.centre, glm::vec3(0.5f)), 1e-6f);
    // regular tetrahedron of edge sqrt(8): circumradius sqrt(3)
    EXPECT_NEAR(boundsOf({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}).radius, std::sqrt(3.0), 2e-6);
    // an obtuse triangle: half its longest side, not its circumradius
    EXPECT_NEAR(boundsOf({{-10, 0, 0}, {10, 0, 0}, {0, 1, 0}}).radius, 10, 1e-5);
}

TEST(BoundingSphere, of_points_on_a_unit_sphere_is_that_sphere) {
    EXPECT_NEAR(boundsOf(randomPoints(20000, 3, true)).radius, 1, 1e-5) << "the largest empty cap of 20,000 points bounds the deficit";
}

TEST(BoundingSphere, contains_every_point) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const auto points = randomPoints(500, seed, false);
        const Bounds bounds = boundsOf(points);
        EXPECT_LE(farthest(points, bounds), bounds.radius) << "seed " << seed;
    }
}

TEST(BoundingSphere, no_nearby_centre_does_better) {
    // The radius as a function of the centre is convex: a local minimum is the minimum.
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const auto points = randomPoints(300, seed, false);
        const Bounds best = boundsOf(points);
        std::mt19937 random(seed);
        std::normal_distribution<float> normal;
        for (int i = 0; i < 50; ++i) {
            Bounds moved = best;
            moved.centre += 1e-2f * glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
            EXPECT_GE(farthest(points, moved) * (1 + 1e-6), best.radius) << "seed " << seed;
        }
    }
}

TEST(BoundingSphere, flat_straight_and_repeated_points_are_no_special_case) {
    EXPECT_NEAR(boundsOf({{0, 0, 0}, {4, 0, 0}, {1, 0, 0}, {4, 0, 0}}).radius, 2, 1e-6);
    EXPECT_EQ(boundsOf({{7, 8, 9}, {7, 8, 9}}).radius, 0);
    EXPECT_EQ(boundsOf({{7, 8, 9}}).centre, glm::vec3(7, 8, 9));
    EXPECT_EQ(boundsOf({}).radius, 0);
    std::vector<glm::vec3> circle;
    for (int i = 0; i < 360; ++i)
        circle.emplace_back(5 * std::cos(i), 5 * std::sin(i), 2);
    EXPECT_NEAR(boundsOf(circle).radius, 5, 1e-5);
}

TEST(BoundingSphere, sizes_at_the_ends_of_float_work) {
    for (const float size : {1e-40f, 1e-30f, 1e20f, 1e37f}) {
        const Bounds bounds = boundsOf({{-size, 0, 0}, {size, 0, 0}, {0, size / 2, 0}});
        EXPECT_NEAR(bounds.radius / size, 1, 1e-4) << "a denormal of 1e-40 has 17 bits";
    }
}

TEST_F(FacingFiles, a_mesh_inside_out_is_told_with_what_turns_it) {
    EXPECT_EQ(codeAmong(load("a.obj", std::string(kCorners) + kOutwards)), 0);
    const auto mesh = load("a.obj", std::string(kCorners) + kInwards);
    EXPECT_EQ(codeAmong(mesh), 5332);
    EXPECT_NE(mesh->warnings.back().hint.find("--orient"), std::string::npos);
}

TEST_F(FacingFiles, neighbours_that_face_opposite_ways_are_told) {
    EXPECT_EQ(codeAmong(load("a.obj", std::string(kCorners) + kMixed)), 5333);
}

TEST_F(FacingFiles, a_surface_that_is_there_once_for_each_side_is_told) {
    EXPECT_EQ(codeAmong(load("a.obj", std::string(kCorners) + kOutwards + "f 4 1 2 3\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\n")), 5334);
}

TEST_F(FacingFiles, triangles_with_two_corners_at_one_place_are_no_doubles) {
    EXPECT_EQ(codeAmong(load(
                  "a.obj", std::string(kCorners) +
                               "v 0 0 0\nv 0 0 0\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"
                               "f 4 1 5 8\n" +
                               [] {
                                   std::string flat;
                                   for (int i = 0; i < 40; ++i)
                                       flat += "f 1 9 10\n";
                                   return flat;
                               }())),
              0);
}

TEST_F(FacingFiles, what_is_flat_or_open_is_not_judged_by_its_sides) {
    EXPECT_EQ(codeAmong(load("a.obj", "v 0 0 0\nv 90 0 0\nv 90 90 0\nv 0 90 0\nf 1 2 3 4\n")), 0) << "a square";
    EXPECT_EQ(codeAmong(load("b.obj", "v 0 0 0\nv 90 0 0\nv 90 90 0\nv 0 90 0\nf 4 3 2 1\n")), 0) << "its back";
    EXPECT_EQ(codeAmong(load("c.obj", "v 0 0 0\nv 90 0 0\nv 90 0 90\nv 0 0 90\nv 45 -10 45\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n")), 0)
        << "a hollow in the ground, seen from above";
}

TEST_F(FacingFiles, a_mesh_far_from_the_origin_is_judged_as_well) {
    EXPECT_EQ(
        codeAmong(load("a.obj", "v 500000 4000000 0\nv 500090 4000000 0\nv 500090 4000090 0\nv 500000 4000090 0\nv 500000 4000000 90\n"
                                "v 500090 4000000 90\nv 500090 4000090 90\nv 500000 4000090 90\n" +
                                    std::string(kInwards))),
        5332);
}

TEST(FacingOfMeshes, a_ball_has_one_and_inside_out_minus_one) {
    Mesh ball; // twenty triangles round each pole are enough to be near
    constexpr int kSteps = 40;
    for (int j = 0; j <= kSteps; ++j)
        for (int i = 0; i < kSteps; ++i) {
            const double a = 2 * 3.14159265358979 * i / kSteps;
            const double b = 3.14159265358979 * j / kSteps;
            ball.positions.emplace_back(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
        }
    for (std::uint32_t j = 0; j < kSteps; ++j)
        for (std::uint32_t i = 0; i < kSteps; ++i) {
            const std::uint32_t a = j * kSteps + i;
            const std::uint32_t b = j * kSteps + (i + 1) % kSteps;
            for (const std::uint32_t index : {a, b, b + kSteps, a, b + kSteps, a + kSteps})
                ball.indices.push_back(index);
        }
    const Facing seen = examineFacing(ball, weldPositions(ball.positions));
    EXPECT_NEAR(seen.outward, 1, 0.01) << "the steps of nine degrees cost less than this";
    EXPECT_EQ(seen.opposed, 0);
    EXPECT_EQ(seen.doubled, 0);
    for (std::size_t i = 0; i < ball.indices.size(); i += 3)
        std::swap(ball.indices[i], ball.indices[i + 1]);
    EXPECT_NEAR(outwardFacing(ball), -1, 0.01);
}

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
