// The pyramid's reference against what boxes, ramps and variances say of it.

#include "lab/reference/spline_pyramid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tegument::reference {
namespace {

TEST(SplineLevels, keep_what_is_even_and_what_rises_evenly) {
    Image ramp{.width = 64, .height = 64, .channels = 2, .pixels = {}};
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            ramp.pixels.insert(ramp.pixels.end(), {3, 2 * (static_cast<float>(x) + 0.5F) - (static_cast<float>(y) + 0.5F)});
    for (const int level : {1, 2, 3}) {
        const int side = 1 << level;
        const Image reduced = splineLevel(ramp, level);
        ASSERT_EQ(reduced.width, 64 / side);
        for (int y = 2; y < reduced.height - 2; ++y)
            for (int x = 2; x < reduced.width - 2; ++x) {
                EXPECT_NEAR(reduced.at(x, y, 0), 3, 1e-5);
                EXPECT_NEAR(reduced.at(x, y, 1), 2 * (x + 0.5) * side - (y + 0.5) * side, 1e-4) << "at its own centre";
            }
        EXPECT_TRUE(std::isnan(reduced.at(0, 0, 0))) << "over the edge nothing is known";
    }
}

TEST(SplineLevels, spread_one_texel_by_one_three_three_one) {
    Image base{.width = 16, .height = 16, .channels = 1, .pixels = std::vector<float>(256, 0)};
    base.at(7, 8, 0) = 64;
    const Image reduced = splineLevel(base, 1);
    // Texel 7 is the second of texel 3 and the first before texel 4; 8 the first of texel 4.
    EXPECT_NEAR(reduced.at(3, 4, 0), 64 * 3 / 8.0 * 3 / 8, 1e-6);
    EXPECT_NEAR(reduced.at(4, 4, 0), 64 * 1 / 8.0 * 3 / 8, 1e-6);
    EXPECT_NEAR(reduced.at(3, 3, 0), 64 * 3 / 8.0 * 1 / 8, 1e-6);
    EXPECT_EQ(reduced.at(5, 4, 0), 0);
}

/// What an edge becomes is the sum of a spread whose parts are independent, so that their variances add up: 1 / 12 of a texel's square, 3 /
/// 4 of each 1 3 3 1 and 3 / 16 of each linear step up in texels of their own levels, 1 / 6 of the last linear look-up.
TEST(SplineEdges, are_even_and_as_wide_as_the_variances_of_their_steps_say) {
    for (const int level : {0, 1, 2, 3}) {
        double expected = 1.0 / 12 + 1.0 / 6;
        for (int i = 0; i < level; ++i)
            expected += (0.75 + 0.1875 * 4) * std::pow(4.0, i);
        const EdgeAnswer edge = splineEdge(level);
        double variance = 0;
        const double step = edge.step / 4;
        for (double x = step / 2; x < -edge.first; x += step) {
            EXPECT_NEAR(edge.at(x) + edge.at(-x), 1, 1e-9) << level << " at " << x;
            variance += 4 * x * (1 - edge.at(x)) * step;
        }
        EXPECT_NEAR(variance, expected, 1.0 / 12 / 16 + 0.005 * expected)
            << level << ": four places of the edge in a texel in place of all";
        EXPECT_EQ(edge.at(2 * edge.first), 0);
        EXPECT_EQ(edge.at(-2 * edge.first), 1);
    }
}

} // namespace
} // namespace tegument::reference
