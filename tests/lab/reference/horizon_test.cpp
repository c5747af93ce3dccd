// Shadows by rays near a body's own horizon, where facets hide each other, beside the round body in closed form.

#include "lab/reference/skin.h"
#include "tests/lab/reference/meshes.h"

#include <gtest/gtest.h>

using namespace tegument;
using namespace tegument::reference;

namespace {

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
