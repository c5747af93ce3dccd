// Walks over a surface against points sown on the triangle that was asked about.
#include "meshprep/prepare/cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace tegument::prep;

namespace {

struct Sheet {
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> triangles;
};

constexpr std::uint32_t kSteps = 10; // squares along each side of the unit square

/// At heights of up to so much. `hole`: without the squares in the middle.
Sheet sheetOf(double height, unsigned seed, bool hole = false) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    Sheet sheet;
    for (std::uint32_t i = 0; i < (kSteps + 1) * (kSteps + 1); ++i) {
        const std::uint32_t row = i / (kSteps + 1);
        sheet.points.emplace_back((i % (kSteps + 1)) * 1.0 / kSteps, row * 1.0 / kSteps, height * unit(random));
    }
    for (std::uint32_t i = 0; i < kSteps * kSteps; ++i) {
        const std::uint32_t x = i % kSteps, y = i / kSteps, a = y * (kSteps + 1) + x;
        if (hole && x > 3 && x < 6 && y > 3 && y < 6) continue;
        sheet.triangles.insert(sheet.triangles.end(), {a, a + 1, a + kSteps + 1, a + 1, a + kSteps + 2, a + kSteps + 1});
    }
    return sheet;
}

using Triangle = std::array<glm::dvec3, 3>;

double farthestOf(const Triangle& triangle, const NearSurface& surface) {
    constexpr int kSown = 40;
    double farthest = 0;
    for (int u = 0; u <= kSown; ++u)
        for (int v = 0; u + v <= kSown; ++v) {
            const glm::dvec3 p = (triangle[0] * static_cast<double>(kSown - u - v) + triangle[1] * static_cast<double>(u) +
                                  triangle[2] * static_cast<double>(v)) /
                                 static_cast<double>(kSown);
            farthest = std::max(farthest, surface.nearest(p).distance);
        }
    return farthest;
}

bool within(const Triangle& triangle, const NearSurface& surface, double most) {
    std::uint32_t near = surface.nearest(triangle[0]).triangle;
    return Cover(surface).within(triangle, near, most);
}

} // namespace

TEST(Cover, never_calls_near_what_is_not) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const double height : {0.02, 0.1, 0.4})
        for (unsigned seed = 0; seed < 60; ++seed) {
            const Sheet sheet = sheetOf(height, seed, seed % 3 == 0);
            const NearSurface surface(sheet.points, sheet.triangles);
            Triangle triangle{};
            for (glm::dvec3& corner : triangle)
                corner = {unit(random), unit(random), height * unit(random)};
            const double truth = farthestOf(triangle, surface);
            for (const double share : {0.3, 0.7, 0.95, 0.999})
                EXPECT_FALSE(within(triangle, surface, share * truth))
                    << "sheet " << seed << " of height " << height << ": " << share << " of " << truth;
        }
}

/// Waves of 0.02 within squares of 0.1 are nearly flat: what is near is found so.
TEST(Cover, finds_a_large_triangle_above_many_small_ones_near) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> unit(0.2, 0.75); // of two hundred triangles it passes over fifty: a walk ends after 96 pieces
    for (unsigned seed = 0; seed < 60; ++seed) {
        const Sheet sheet = sheetOf(0.02, seed);
        const NearSurface surface(sheet.points, sheet.triangles);
        Triangle triangle{};
        for (glm::dvec3& corner : triangle)
            corner = {unit(random), unit(random), 0.01};
        // A point's height over the sheet is at most 1.06 times its distance, the steepest side rising 0.02 * sqrt(2) in 0.1.
        EXPECT_TRUE(within(triangle, surface, 1.06 * farthestOf(triangle, surface) + 1e-3)) << seed;
    }
}

TEST(Cover, does_not_pass_over_a_hole) {
    const Sheet sheet = sheetOf(0, 1, true);
    const NearSurface surface(sheet.points, sheet.triangles);
    const Triangle above = {glm::dvec3(0.05, 0.05, 0), glm::dvec3(0.95, 0.1, 0), glm::dvec3(0.4, 0.95, 0)};
    EXPECT_FALSE(within(above, surface, 0.05)) << "the middle is 0.1 from the hole's edge";
    EXPECT_TRUE(within({glm::dvec3(0.05, 0.05, 0), glm::dvec3(0.35, 0.1, 0), glm::dvec3(0.1, 0.35, 0)}, surface, 1e-6));
}

/// Places that lie up to two squares beside their own: the sheet passes over itself, and some of its triangles have next to no area.
TEST(Cover, never_calls_near_what_is_not_below_folds) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    std::size_t found = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        Sheet sheet = sheetOf(0.1, seed, seed % 3 == 0);
        const double aside = 0.2 * unit(random);
        for (glm::dvec3& point : sheet.points)
            point += glm::dvec3(aside * (unit(random) - 0.5), seed % 2 == 0 ? aside * (unit(random) - 0.5) : 0, 0);
        const NearSurface surface(sheet.points, sheet.triangles);
        Triangle triangle{};
        for (glm::dvec3& corner : triangle)
            corner = {unit(random), unit(random), 0.1 * unit(random)};
        const double truth = farthestOf(triangle, surface);
        EXPECT_FALSE(within(triangle, surface, 0.98 * truth)) << "sheet " << seed;
        found += within(triangle, surface, 2 * truth);
    }
    EXPECT_GT(found, 40u) << "of 200: what is near must be found, too";
}

/// Three corners on a line lie over nothing, whatever their plane seems to be.
TEST(Cover, a_triangle_without_area_hides_nothing) {
    const std::vector<glm::dvec3> points = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}};
    const std::vector<std::uint32_t> triangles = {0, 1, 2};
    EXPECT_FALSE(within({glm::dvec3(0.2, 0, 0), glm::dvec3(0.8, 0, 0), glm::dvec3(0.5, 0.7, 0)}, NearSurface(points, triangles), 0.1));
}

/// A fin stands on a side: the sheet does not go on across sides of three triangles.
TEST(Cover, ends_where_three_triangles_meet) {
    Sheet sheet = sheetOf(0, 1);
    const auto tip = static_cast<std::uint32_t>(sheet.points.size());
    sheet.points.emplace_back(0.55, 0.5, 0.3);
    const std::uint32_t middle = 5 * (kSteps + 1) + 5;
    sheet.triangles.insert(sheet.triangles.end(), {middle, middle + 1, tip});
    const NearSurface surface(sheet.points, sheet.triangles);
    EXPECT_FALSE(within({glm::dvec3(0.5, 0.45, 0), glm::dvec3(0.6, 0.45, 0), glm::dvec3(0.55, 0.56, 0)}, surface, 0.01));
    EXPECT_TRUE(within({glm::dvec3(0.1, 0.1, 0), glm::dvec3(0.4, 0.15, 0), glm::dvec3(0.2, 0.4, 0)}, surface, 1e-6));
}

/// A ridge passes over the triangle, whose corners are low: what is high lies on a side of both of the roof's triangles alone, whichever it
/// is.
TEST(Cover, looks_at_every_side_that_passes_over) {
    const std::vector<glm::dvec3> points = {{0, -10, 1}, {0, 10, 1}, {10, 0, -9}, {-10, 0, -9}}; // z = 1 - |x|
    const Triangle below = {glm::dvec3(-1, -1, 0), glm::dvec3(1, -1, 0), glm::dvec3(1, 1, 0)};
    for (std::uint32_t turn = 0; turn < 3; ++turn) {
        std::vector<std::uint32_t> triangles;
        for (const std::array<std::uint32_t, 3>& side : {std::array<std::uint32_t, 3>{1, 0, 2}, std::array<std::uint32_t, 3>{0, 1, 3}})
            for (std::uint32_t i = 0; i < 3; ++i)
                triangles.push_back(side[(turn + i) % 3]);
        const NearSurface roof(points, triangles);
        EXPECT_FALSE(within(below, roof, 0.69)) << turn << ": below the ridge the roof is sqrt(1/2) away";
        EXPECT_TRUE(within(below, roof, 1.01)) << turn << ": straight above it";
    }
}
