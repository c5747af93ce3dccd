// Both trees against what a search through all faces and pieces finds, in double precision.

#include "meshprep/rays/box_tree.h"
#include "meshprep/rays/surface_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace tegument::test {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

struct Soup {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
};

glm::vec3 randomPoint(std::mt19937& random) {
    std::uniform_real_distribution<float> place(-1, 1);
    const float x = place(random);
    const float y = place(random);
    return {x, y, place(random)};
}

Soup randomTriangles(std::mt19937& random, std::uint32_t count) {
    Soup soup;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 middle = randomPoint(random);
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            soup.positions.push_back(middle + 0.2F * randomPoint(random));
            soup.indices.push_back(3 * i + corner);
        }
    }
    return soup;
}

/// Distance along a ray, and how far the nearest edge is from it as a share of the triangle: rounding decides there.
struct Crossing {
    double distance = kFar;
    double margin = 0;
};
Crossing cross(const Soup& soup, std::size_t face, const glm::dvec3& origin, const glm::dvec3& direction) {
    const glm::dvec3 a(soup.positions[3 * face]);
    const glm::dvec3 ab = glm::dvec3(soup.positions[3 * face + 1]) - a;
    const glm::dvec3 ac = glm::dvec3(soup.positions[3 * face + 2]) - a;
    const glm::dvec3 p = glm::cross(direction, ac);
    const double volume = glm::dot(ab, p);
    const double u = glm::dot(origin - a, p) / volume;
    const glm::dvec3 q = glm::cross(origin - a, ab);
    const double v = glm::dot(direction, q) / volume;
    const double margin = std::min({u, v, 1 - u - v});
    const double t = glm::dot(ac, q) / volume;
    if (margin < 0 || t < 0) return {.distance = kFar, .margin = std::abs(margin)};
    return {.distance = t, .margin = std::abs(margin)};
}

TEST(Rays, the_tree_of_a_surface_finds_the_face_that_a_search_through_all_finds) {
    constexpr double kEdge = 1e-3; // of a triangle: nearer to an edge, single precision may decide otherwise
    std::mt19937 random(1);
    const Soup soup = randomTriangles(random, 400);
    const SurfaceTree tree(soup.positions, soup.indices, {.watertight = true});
    int compared = 0;
    for (int ray = 0; ray < 2000; ++ray) {
        const glm::vec3 origin = 2.0F * randomPoint(random);
        const glm::vec3 direction = glm::normalize(randomPoint(random));
        std::uint32_t face = 0;
        double nearest = kFar;
        bool close = false;
        for (std::uint32_t i = 0; i < soup.indices.size() / 3; ++i) {
            const Crossing found = cross(soup, i, origin, direction);
            close = close || found.margin < kEdge;
            if (found.distance < nearest) nearest = found.distance, face = i;
        }
        if (close) continue;
        const auto hit = tree.nearest(origin, direction);
        ASSERT_EQ(hit.has_value(), nearest < kFar) << "ray " << ray;
        EXPECT_EQ(tree.meetsAny(origin, direction), hit.has_value()) << "ray " << ray;
        if (!hit) continue;
        EXPECT_EQ(hit->face, face) << "ray " << ray;
        EXPECT_NEAR(hit->distance, nearest, 1e-4) << "ray " << ray; // single precision at a distance of up to 4, at grazing angles
        ++compared;
    }
    EXPECT_GT(compared, 150);
}

TEST(Rays, a_range_hides_what_lies_before_and_behind_it) {
    const std::vector<glm::vec3> positions = {{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}, {-1, -1, 2}, {1, -1, 2}, {0, 1, 2}};
    const std::vector<std::uint32_t> indices = {0, 1, 2, 3, 4, 5};
    const SurfaceTree tree(positions, indices, {});
    const glm::vec3 ahead(0, 0, 1);
    EXPECT_EQ(tree.nearest({}, ahead)->face, 0U);
    EXPECT_EQ(tree.nearest({}, ahead, {.first = 1.5F})->face, 1U);
    EXPECT_FALSE(tree.nearest({}, ahead, {.first = 1.5F, .last = 1.75F}).has_value());
}

struct Ball {
    glm::dvec3 centre{0};
    double radius = 0;

    [[nodiscard]] double enter(const glm::dvec3& origin, const glm::dvec3& direction) const {
        const double b = glm::dot(origin - centre, direction);
        const double discriminant = b * b - glm::dot(origin - centre, origin - centre) + radius * radius;
        if (discriminant < 0) return kFar;
        const double t = -b - std::sqrt(discriminant);
        if (!(t > 0)) return kFar;
        return t;
    }
};

TEST(Rays, the_tree_of_pieces_names_every_piece_that_may_be_the_nearest) {
    std::mt19937 random(2);
    std::vector<Ball> balls;
    std::vector<PieceBox> boxes;
    for (int i = 0; i < 500; ++i) {
        balls.push_back({.centre = randomPoint(random), .radius = 0.05});
        boxes.push_back({.low = glm::vec3(balls.back().centre - 0.0501), .high = glm::vec3(balls.back().centre + 0.0501)});
    }
    const BoxTree tree(boxes);
    std::size_t named = 0;
    int met = 0;
    for (int ray = 0; ray < 2000; ++ray) {
        const glm::dvec3 origin = 2.0F * randomPoint(random);
        const glm::dvec3 direction = glm::normalize(glm::dvec3(randomPoint(random)));
        double nearest = kFar;
        for (const Ball& ball : balls)
            nearest = std::min(nearest, ball.enter(origin, direction));
        double found = kFar;
        tree.meetAlong(glm::vec3(origin), glm::vec3(direction), std::numeric_limits<float>::infinity(), [&](std::uint32_t i) {
            ++named;
            found = std::min(found, balls[i].enter(origin, direction));
            return static_cast<float>(found * (1 + 1e-5));
        });
        EXPECT_EQ(found, nearest) << "ray " << ray;
        met += nearest < kFar ? 1 : 0;
    }
    EXPECT_GT(met, 150);
    EXPECT_LT(named, 20 * 2000U); // of 500 each: the tree leaves out what the ray does not come near
}

TEST(Rays, pieces_behind_the_last_distance_are_not_named) {
    const std::vector<PieceBox> boxes = {{.low = {-1, -1, 1}, .high = {1, 1, 2}}, {.low = {-1, -1, 4}, .high = {1, 1, 5}}};
    const BoxTree tree(boxes);
    std::vector<std::uint32_t> named;
    tree.meetAlong({}, {0, 0, 1}, 3, [&](std::uint32_t i) {
        named.push_back(i);
        return std::numeric_limits<float>::infinity(); // a greater distance widens nothing
    });
    EXPECT_EQ(named, std::vector<std::uint32_t>{0});
}

TEST(Rays, pieces_behind_the_one_that_was_met_are_left_out) {
    std::vector<PieceBox> boxes;
    for (int i = 0; i < 500; ++i)
        boxes.push_back({.low = {-1, -1, 2 * i + 1}, .high = {1, 1, 2 * i + 2}});
    const BoxTree tree(boxes);
    int named = 0;
    float nearest = std::numeric_limits<float>::infinity();
    tree.meetAlong({}, {0, 0, 1}, nearest, [&](std::uint32_t i) {
        ++named;
        nearest = std::min(nearest, boxes[i].low.z);
        return nearest;
    });
    EXPECT_EQ(nearest, 1);
    EXPECT_LT(named, 50); // of 500 in the ray's way: those of the first leaves
}

} // namespace
} // namespace tegument::test
