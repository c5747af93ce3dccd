#include "host/mesh/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace tegument;

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
