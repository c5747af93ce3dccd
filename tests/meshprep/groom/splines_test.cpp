// Curves from control points, and points along chains.

#include "tests/meshprep/groom/grooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace tegument;

namespace {

Groom oneStrand(Spline spline, std::vector<glm::vec3> points, bool pinned = false) {
    Groom groom{.points = std::move(points), .spline = spline, .pinned = pinned};
    groom.endStrand();
    return groom;
}

glm::dvec3 casteljau(std::vector<glm::dvec3> p, double t) {
    for (std::size_t n = p.size() - 1; n > 0; --n)
        for (std::size_t i = 0; i < n; ++i)
            p[i] = glm::mix(p[i], p[i + 1], t);
    return p[0];
}

/// Of a uniform B-spline of any degree (C. de Boor, 1972), by its recursion.
double deBoor(int i, int degree, double x) {
    if (degree == 0) return x >= i && x < i + 1 ? 1 : 0;
    return (x - i) / degree * deBoor(i, degree - 1, x) + (i + degree + 1 - x) / degree * deBoor(i + 1, degree - 1, x);
}

const std::vector<glm::vec3> kControls = {{0, 0, 0}, {1, 2, -1}, {3, 3, 0}, {4, 1, 2}, {6, 0, 1}, {7, 2, 0}, {9, 1, -2}};

} // namespace

TEST(Splines, of_bezier_are_where_de_casteljau_has_them) {
    const Groom chain = evaluated(oneStrand(Spline::Bezier, kControls), 8);
    ASSERT_EQ(chain.points.size(), 17U);
    for (std::size_t span = 0; span < 2; ++span)
        for (std::size_t k = 0; k <= 8; ++k) {
            const auto from = kControls.begin() + static_cast<std::ptrdiff_t>(3 * span);
            const glm::dvec3 right = casteljau({from, from + 4}, static_cast<double>(k) / 8);
            EXPECT_LT(glm::distance(glm::dvec3(chain.points[8 * span + k]), right), 1e-5);
        }
}

TEST(Splines, of_b_splines_are_where_de_boor_has_them) {
    const Groom chain = evaluated(oneStrand(Spline::BSpline, kControls), 8);
    ASSERT_EQ(chain.points.size(), 17U);
    for (std::size_t k = 0; k + 1 < chain.points.size(); ++k) {
        glm::dvec3 right(0);
        for (int i = 0; i < 7; ++i)
            right += deBoor(i, 3, 3 + static_cast<double>(k) / 4) * glm::dvec3(kControls[static_cast<std::size_t>(i)]);
        EXPECT_LT(glm::distance(glm::dvec3(chain.points[k]), right), 1e-5) << k;
    }
}

TEST(Splines, of_catmull_and_rom_pass_through_their_points_along_their_neighbours) {
    const Groom chain = evaluated(oneStrand(Spline::CatmullRom, kControls), 200);
    for (std::size_t i = 1; i + 1 < kControls.size(); ++i) {
        const std::size_t at = 100 * (i - 1);
        EXPECT_LT(glm::distance(chain.points[at], kControls[i]), 1e-5F);
        if (i + 2 >= kControls.size()) continue;
        const glm::vec3 runs = (chain.points[at + 1] - chain.points[at]) * 100.0F;
        EXPECT_LT(glm::distance(runs, 0.5F * (kControls[i + 1] - kControls[i - 1])), 0.05F);
    }
}

TEST(Splines, that_are_pinned_begin_and_end_at_their_ends) {
    for (const Spline spline : {Spline::BSpline, Spline::CatmullRom}) {
        const Groom chain = evaluated(oneStrand(spline, kControls, true));
        EXPECT_LT(glm::distance(chain.points.front(), kControls.front()), 1e-5F);
        EXPECT_LT(glm::distance(chain.points.back(), kControls.back()), 1e-5F);
    }
}

TEST(Chains, are_divided_without_leaving_their_course_and_evenly_where_points_go) {
    const std::vector<float> more = dividedPlaces(kControls, 20);
    ASSERT_EQ(more.size(), 20U);
    for (std::size_t i = 0; i < kControls.size(); ++i)
        EXPECT_NE(std::ranges::find(more, static_cast<float>(i)), more.end()) << "every point stays";
    const std::vector<float> even = evenPlaces(kControls, 5);
    std::vector<float> steps;
    float length = 0;
    for (std::size_t i = 1; i < kControls.size(); ++i)
        length += glm::distance(kControls[i - 1], kControls[i]);
    float along = 0;
    for (std::size_t i = 0, at = 0; i < even.size(); ++i) {
        for (; static_cast<float>(at + 1) <= even[i]; ++at)
            along += glm::distance(kControls[at], kControls[at + 1]);
        const float rest = even[i] > static_cast<float>(at) ? glm::distance(kControls[at], atPlace(kControls, even[i])) : 0;
        EXPECT_NEAR(along + rest, length * static_cast<float>(i) / 4, 1e-4F);
    }
}
