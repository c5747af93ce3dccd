// Strands in space beside what is known of them without meshes and searches.
// The fur patch whose picture is known, beside cones and layers.
// Shadows by rays near a body's own horizon, where facets hide each other, beside the round body in closed form.

#include "lab/reference/fur_body.h"
#include "lab/reference/fur_exact.h"
#include "lab/reference/fur_patch.h"
#include "lab/reference/pinhole.h"
#include "lab/reference/skin.h"
#include "tests/lab/reference/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace tegument::reference {

namespace {

Mesh quadGrid(int across, int down, const std::function<glm::dvec3(double, double)>& at,
              const std::function<glm::dvec3(const glm::dvec3&)>& normal) {
    Mesh mesh;
    for (int j = 0; j <= down; ++j)
        for (int i = 0; i <= across; ++i) {
            const glm::dvec3 p = at(static_cast<double>(i) / across, static_cast<double>(j) / down);
            mesh.positions.emplace_back(p);
            mesh.normals.emplace_back(normal(p));
        }
    addGrid(mesh.indices, static_cast<std::uint32_t>(across), static_cast<std::uint32_t>(down), "acdadb");
    computeBounds(mesh);
    return mesh;
}

/// y up, 20 mm wide.
Mesh furPlane() {
    return quadGrid(
        8, 8, [](double u, double v) { return glm::dvec3(20 * u - 10, 0, 20 * v - 10); },
        [](const glm::dvec3&) { return glm::dvec3(0, 1, 0); });
}

Mesh ball() {
    return quadGrid(
        768, 384,
        [](double u, double v) {
            const double a = 2 * std::numbers::pi * u;
            const double b = std::numbers::pi * v;
            return glm::dvec3(std::sin(b) * std::cos(a), std::cos(b), -std::sin(b) * std::sin(a));
        },
        [](const glm::dvec3& p) { return glm::normalize(p); });
}

constexpr FurStrandShape kBent{.spacing = 1, .thickness = 4, .scatter = 0.4, .curls = 0.15, .turns = 1, .tufts = 1.5, .tuftSize = 4};

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

/// Height of the topmost of many layers on which the ray is inside a strand.
double byLayers(const FurPatch& patch, const FurRay& ray, int layers) {
    for (int l = layers; l >= 1; --l)
        if (const double h = (l - 0.5) / layers; heightOver(patch, ray.x + ray.run * (1 - h), ray.y) >= h) return h;
    return kNoHit;
}

TEST(FurPatch, seen_from_above_covers_what_its_cones_cover) {
    // From above a strand is its base disc; discs of 0.38 around roots that stray by 0.3 may overlap, so count by a fine grid of disc
    // tests.
    const FurPatch patch;
    double covered = 0;
    int total = 0;
    for (int j = 0; j < 320; ++j)
        for (int i = 0; i < 320; ++i) {
            covered += exactHit(patch, {.x = (i + 0.5) / 16, .y = (j + 0.5) / 16, .run = 0}) == kNoHit ? 0 : 1;
            ++total;
        }
    // pi 0.38^2 = 0.454 of the area less overlaps of neighbours, a few hundredths.
    EXPECT_GT(covered / total, 0.40);
    EXPECT_LE(covered / total, 0.4537 + 0.01);
}

TEST(FurPatch, a_hit_lies_on_a_cone_and_nothing_above_it_is_inside_one) {
    const FurPatch patch{.coat = 12};
    for (int i = 0; i < 600; ++i) {
        const FurRay ray{.x = 0.37 * i, .y = 0.611 * i, .run = 0.01 * i};
        const double hit = exactHit(patch, ray);
        ASSERT_LE(byLayers(patch, ray, 2001), hit + 1e-9) << "ray " << i;
    }
}

TEST(FurPatch, many_layers_come_to_the_exact_picture) {
    const FurPatch patch;
    constexpr int kSide = 36;
    for (const double tilt : {0.0, 45.0, 70.0}) {
        double apart = 0;
        for (int i = 0; i < kSide * kSide; ++i) {
            const FurRay ray{.x = i % kSide / 6.0, .y = i / kSide / 6.0, .run = patch.coat * std::tan(radians(tilt))};
            apart += (exactHit(patch, ray) - byLayers(patch, ray, 2048)) / (kSide * kSide);
        }
        EXPECT_NEAR(apart, 0, 3e-3) << tilt << " degrees: 2048 layers leave 0.27 * 4 * tan(tilt) / 2048, 1.4e-3 at most";
    }
}

using namespace tegument::reference;

constexpr double kRadius = 80;    // mm, of a head
constexpr double kFarLight = 1e5; // mm: the light is as good as directional

struct Counted {
    int points = 0;
    int wrong = 0;
};

/// Points inside of each facet, with N.L of the ball in a range, whose shadow is not as expected.
Counted wrongShadows(int levels, double from, double to, bool lit) {
    const Mesh mesh = sphereMesh(static_cast<float>(kRadius), levels);
    const SkinScene skin(mesh, lightPyramid({0, 0, kFarLight}, {0, 0, 0}, kRadius + 1, 256), glm::dvec3(1), {});
    Counted counted;
    for (std::uint32_t triangle = 0; 3 * static_cast<std::size_t>(triangle) < mesh.indices.size(); ++triangle)
        for (const glm::dvec3& weights : {glm::dvec3(1, 1, 1) / 3.0, glm::dvec3(0.8, 0.1, 0.1), glm::dvec3(0.1, 0.8, 0.1),
                                          glm::dvec3(0.1, 0.1, 0.8), glm::dvec3(0.45, 0.45, 0.1), glm::dvec3(0.1, 0.45, 0.45)}) {
            const SurfacePoint point = interpolate(mesh, {triangle, weights});
            const double cosine = glm::normalize(point.position).z;
            if (cosine < from || cosine > to) continue;
            ++counted.points;
            counted.wrong += skin.lit(point) != lit;
        }
    return counted;
}

} // namespace

TEST(FurExact, straight_strands_on_a_ball_are_cones_along_its_normals) {
    const Mesh mesh = ball();
    const RayScene skin(mesh);
    std::mt19937 random(3);
    const auto next = [&] { return static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 0.5; };
    std::vector<FurGrown> strands;
    std::vector<FurCone> cones;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(next(), next(), next()));
        const double length = 0.75 + 0.5 * next();
        strands.push_back({.root = n, .length = length, .radius = 0.015});
        cones.push_back({.root = n, .normal = n, .length = 0.15 * length, .radius = 0.015});
    }
    const FurExact exact(skin, {.spacing = 0.05, .thickness = 0.15}, strands);
    const FurOnBody body({.radius = 1}, 0.15, cones);
    int strandsMet = 0;
    int apart = 0;
    constexpr int kRays = 4000;
    for (int i = 0; i < kRays; ++i) {
        const glm::dvec3 eye = 3.0 * glm::normalize(glm::dvec3(next(), next(), next()));
        const glm::dvec3 direction = glm::normalize(0.6 * glm::dvec3(next(), next(), next()) - eye);
        const auto a = exact.meet(eye, direction);
        const auto b = body.meet(eye, direction, FurShape::Cones);
        ASSERT_TRUE(a.has_value());
        ASSERT_TRUE(b.has_value());
        strandsMet += b->strand ? 1 : 0;
        // Rays that graze: the mesh lies up to 1e-5 inside of the ball, discs are parallel to its triangles.
        if ((a->strand != nullptr) != b->strand || std::abs(a->along - b->along) > 2e-3) ++apart;
    }
    EXPECT_GT(strandsMet, kRays / 10);
    EXPECT_LT(apart, kRays / 200);
}

TEST(FurExact, a_leaning_strand_is_met_where_its_parabola_is) {
    const Mesh mesh = furPlane();
    const RayScene skin(mesh);
    constexpr double kLean = 0.5;
    const FurStrandShape shape{.spacing = 1, .thickness = 4, .lean = {kLean, 0, 0}};
    const FurExact exact(skin, shape, {{.root = {1, 0, 0}, .length = 1, .radius = 0.2}}, 64);
    for (const double h : {0.1, 0.4, 0.8}) {
        // From the side, level: the axis is at x = 1 + 4 * 0.5 h^2, the disc's radius 0.2 (1 - h).
        const auto hit = exact.meet({-8, 4 * h, 0}, {1, 0, 0});
        ASSERT_TRUE(hit && hit->strand) << h;
        EXPECT_NEAR(hit->distance, 9 + 4 * kLean * h * h - 0.2 * (1 - h), 2e-4) << h; // 64 chords of the parabola
        EXPECT_NEAR(hit->along, h, 1e-6) << h;
        EXPECT_FALSE(exact.meet({-8, 4 * h, 0.201 * (1 - h)}, {1, 0, 0})) << h;
    }
}

TEST(FurExact, the_foot_of_a_strand_in_a_tuft_is_looked_up_where_the_strand_stands) {
    // By its definition: what is seen at the place p without tufts is what stands at p + tuft(p).
    const Mesh mesh = furPlane();
    const RayScene skin(mesh);
    FurStrandShape alone = kBent;
    alone.scatter = alone.curls = 0;
    const auto joints = axisOf(skin, alone, {.root = {0.3, 0, -0.4}, .radius = 0.3}, 8);
    ASSERT_EQ(joints.size(), 9U);
    for (const FurJoint& joint : joints) {
        const double h = joint.height;
        const auto wave = [](double x) { // a cubic from 1 at whole numbers to -1 between them
            const double t = std::abs(x - std::round(x));
            return 1 - 2 * (12 * t * t - 16 * t * t * t);
        };
        const glm::dvec3 p = glm::dvec3(joint.position.x, 0, joint.position.z) / alone.tuftSize;
        const glm::dvec3 tuft =
            alone.tufts * h * h * glm::dvec3(wave(0.31 * p.y + 0.4 * wave(0.19 * p.z)), 0, wave(0.31 * p.x + 0.4 * wave(0.19 * p.y)));
        EXPECT_NEAR(joint.position.x + tuft.x, 0.3, 1e-3) << h;
        EXPECT_NEAR(joint.position.z + tuft.z, -0.4, 1e-3) << h;
        EXPECT_NEAR(joint.position.y, alone.thickness * h, 1e-9);
    }
}

TEST(FurExact, twice_as_many_pieces_change_an_axis_by_less_than_a_hundredth_of_a_spacing) {
    const Mesh mesh = furPlane();
    const RayScene skin(mesh);
    const FurGrown strand{.root = {2, 0, 1}, .radius = 0.3, .side = {1, 0.3, 0.2}};
    const auto some = axisOf(skin, kBent, strand, 12);
    const auto more = axisOf(skin, kBent, strand, 24);
    ASSERT_EQ(some.size(), 13U);
    ASSERT_EQ(more.size(), 25U);
    for (std::size_t i = 0; i < 12; ++i)
        EXPECT_LT(glm::distance(0.5 * (some[i].position + some[i + 1].position), more[2 * i + 1].position), 0.01) << i;
}

TEST(FurExact, the_lattice_grows_a_strand_per_square_on_skin_of_any_direction) {
    for (const glm::dvec3& turn : {glm::dvec3(0, 1, 0), glm::dvec3(0.6, 0.8, 0), glm::dvec3(0.48, 0.64, 0.6)}) {
        const glm::dvec3 across = glm::normalize(glm::cross(turn, glm::dvec3(0.3, 0.1, 0.9)));
        const glm::dvec3 down = glm::cross(turn, across);
        const Mesh mesh = quadGrid(
            4, 4, [&](double u, double v) { return (60 * u - 30) * across - (60 * v - 30) * down + 0.2 * turn; },
            [&](const glm::dvec3&) { return turn; });
        const RayScene skin(mesh);
        const auto strands = latticeOn(skin, {.spacing = 1, .shortest = 0.5}, [](const glm::dvec3&) { return true; });
        // Independent points would vary by 1/60 of their number; one to a cube varies less. The border adds half a spacing all around.
        EXPECT_NEAR(static_cast<double>(strands.size()), 60.0 * 60 + 2 * 60, 180) << turn.x;
        for (const FurGrown& strand : strands)
            ASSERT_LE(strand.length, 1);
    }
}

TEST(FurExact, a_point_on_the_grid_appears_at_a_multiple_of_it_at_its_own_depth) {
    const Pinhole view = pinhole({1, 2, 30}, {0, 0.5, 0}, {0, 1, 0}, 0.6, 320, 240);
    for (const glm::dvec3& point : {glm::dvec3(0.123, 0.456, 1), glm::dvec3(-3.3, 2.1, -5)}) {
        const glm::dvec3 moved = view.onGrid(point, 1.0 / 256);
        const glm::dvec2 steps = 256.0 * view.project(moved) * glm::dvec2(320, 240);
        EXPECT_NEAR(steps.x, std::round(steps.x), 1e-6);
        EXPECT_NEAR(steps.y, std::round(steps.y), 1e-6);
        EXPECT_NEAR(glm::dot(moved - view.eye, view.forward), glm::dot(point - view.eye, view.forward), 1e-12);
        const glm::dvec2 way = (view.project(moved) - view.project(point)) * glm::dvec2(320, 240);
        EXPECT_LE(std::max(std::abs(way.x), std::abs(way.y)), 0.5 / 256 + 1e-9);
    }
}

TEST(Horizon, facets_do_not_hide_the_ball_that_they_stand_for) {
    for (const int levels : {3, 4, 5}) { // edges of 16, 8 and 4 mm; a ball hides none of its points that face the light
        const Counted counted = wrongShadows(levels, 0.002, 1, true);
        EXPECT_GT(counted.points, 1000);
        EXPECT_EQ(counted.wrong, 0) << levels << ", of " << counted.points;
    }
}

TEST(Horizon, what_lies_behind_the_horizon_is_dark) {
    // A point is raised by at most twice the height h of the ball over its facets, and sees over the horizon by sqrt(2 h / 80 mm) then.
    for (const auto& [levels, behind] : {std::pair{3, 0.16}, {4, 0.09}, {5, 0.05}}) {
        const Counted counted = wrongShadows(levels, -1, -behind, false);
        EXPECT_GT(counted.points, 1000);
        EXPECT_EQ(counted.wrong, 0) << levels << ", of " << counted.points;
    }
}

} // namespace tegument::reference
