// The tree of boxes against looking at every triangle.
#include "meshprep/prepare/near_surface.h"

#include <gtest/gtest.h>

#include <random>

using namespace tegument::prep;

namespace {

struct Soup {
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> triangles;
};

/// Triangles up to so long, in the unit cube.
Soup soupOf(std::size_t count, double length, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto point = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
    Soup soup;
    for (std::uint32_t i = 0; i < 3 * count; ++i) {
        const glm::dvec3 first = i % 3 == 0 ? point() : soup.points[i - i % 3];
        soup.points.push_back(glm::clamp(first + (i % 3) * 0.5 * length * (point() - 0.5), 0.0, 1.0));
        soup.triangles.push_back(i);
    }
    return soup;
}

double nearestOfAll(const NearSurface& surface, const glm::dvec3& point) {
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < surface.size(); ++i)
        least = std::min(least, surface.distanceTo(i, point));
    return least;
}

} // namespace

TEST(NearTree, finds_what_looking_at_every_triangle_finds) {
    for (const std::size_t count : {1u, 2u, 4u, 5u, 17u, 300u, 5'000u})
        for (const double length : {0.0, 0.02, 0.2}) {
            const Soup soup = soupOf(count, length, static_cast<unsigned>(count));
            const NearSurface surface(soup.points, soup.triangles);
            const Soup asked = soupOf(30, 1, 7);
            for (const glm::dvec3& point : asked.points) {
                const NearestTriangle found = surface.nearest(point);
                if (!found.exact) continue; // long triangles cross one another: asked below
                if (length == 0) continue;  // without area: no distance
                EXPECT_NEAR(found.distance, nearestOfAll(surface, point), 1e-6) << count << " triangles as long as " << length;
                EXPECT_NEAR(found.distance, surface.distanceTo(found.triangle, point), 1e-12);
            }
        }
}

TEST(NearTree, answers_are_exact_on_a_mesh_whose_triangles_seldom_cross) {
    const Soup soup = soupOf(5'000, 0.02, 3);
    const NearSurface surface(soup.points, soup.triangles);
    for (const glm::dvec3& point : soupOf(100, 1, 5).points)
        EXPECT_TRUE(surface.nearest(point).exact);
}

TEST(NearTree, takes_a_million_triangles_at_one_place_in_its_stride) {
    Soup soup = soupOf(1, 0.1, 1);
    for (std::uint32_t i = 3; i < 3'000'000; ++i)
        soup.triangles.push_back(i % 3);
    const NearSurface surface(soup.points, soup.triangles);
    const NearestTriangle found = surface.nearest(soup.points[0] + glm::dvec3(0, 0, 0.25));
    EXPECT_NEAR(found.distance, nearestOfAll(surface, soup.points[0] + glm::dvec3(0, 0, 0.25)), 1e-6);
}

TEST(NearTree, names_every_triangle_once_along_its_curve_and_near_ones_together) {
    const Soup soup = soupOf(5'000, 0.01, 2);
    const NearSurface surface(soup.points, soup.triangles);
    std::vector<bool> named(surface.size(), false);
    double way = 0;
    const auto placeOf = [&](std::size_t i) { return surface.triangle(surface.alongCurve()[i])[0]; };
    ASSERT_EQ(surface.alongCurve().size(), surface.size());
    for (std::size_t i = 0; i < surface.size(); ++i) {
        EXPECT_FALSE(named[surface.alongCurve()[i]]);
        named[surface.alongCurve()[i]] = true;
        if (i > 0) way += glm::distance(placeOf(i), placeOf(i - 1));
    }
    EXPECT_LT(way / 5'000, 0.1) << "in any order 0.66, the mean distance of two points of the cube";
}

TEST(NearTree, has_nothing_near_where_it_is_empty) {
    const std::vector<glm::dvec3> points;
    const NearSurface surface(points, {});
    EXPECT_TRUE(std::isinf(surface.nearest(glm::dvec3(0.5)).distance));
}
