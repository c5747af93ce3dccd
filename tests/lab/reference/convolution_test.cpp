// The convolutions of the references: laws of a Gaussian on a grid, and the printed kernels' own figures.
// The one-dimensional study of the printed pipeline, within 15 % or 0.002 of an independent one (its rows are quoted here).
// The pyramid's reference against what boxes, ramps and variances say of it.

#include "lab/reference/convolution.h"
#include "lab/reference/edge_study.h"
#include "lab/reference/spline_pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::reference {

namespace {

using namespace tegument::reference;

double varianceOf(const std::vector<double>& half) {
    double sum = 0;
    for (std::size_t n = 1; n < half.size(); ++n)
        sum += 2 * half[n] * static_cast<double>(n * n);
    return sum;
}

double sumOf(const std::vector<double>& half) {
    double sum = half[0];
    for (std::size_t n = 1; n < half.size(); ++n)
        sum += 2 * half[n];
    return sum;
}

/// One bright texel in the middle of a map that is valid everywhere but in column 20.
Map point(int size) {
    Map map{.size = size,
            .texels = std::vector<glm::dvec4>(static_cast<std::size_t>(size * size), glm::dvec4(0)),
            .valid = std::vector<std::uint8_t>(static_cast<std::size_t>(size * size), 1)};
    map.texels[map.index(size / 2, size / 2)] = glm::dvec4(1);
    return map;
}

double total(const Map& map) {
    double sum = 0;
    for (const glm::dvec4& texel : map.texels)
        sum += texel.x;
    return sum;
}

constexpr double kFootprint = 0.25; // mm: a head that fills a picture of 1080 lines
constexpr int kPhases = 8;

void expectPublished(const glm::dvec3& value, const glm::dvec3& published, const char* what) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(value[c], published[c], std::max(0.15 * published[c], 0.002)) << what << ", channel " << c;
}

EdgeError errorAtEdge(const EdgePipeline& pipeline) {
    return edgeError([&](double phase) { return edgeOf(pipeline, phase); }, kFootprint, kPhases);
}

TEST(SplineLevels, keep_what_is_even_and_what_rises_evenly) {
    Image ramp{.width = 64, .height = 64, .channels = 2};
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

TEST(GridGaussian, sums_to_one_and_has_its_variance) {
    for (double variance : {0.0, 0.01, 0.3, 1.0, 7.0, 64.0}) {
        EXPECT_NEAR(sumOf(gridGaussian(variance)), 1, 1e-6) << variance; // what was cut
        EXPECT_NEAR(varianceOf(gridGaussian(variance)), variance, 1e-5 * std::max(variance, 0.1)) << variance;
    }
}

TEST(GridGaussian, is_the_continuous_one_where_it_is_wide) {
    const auto weights = gridGaussian(25);
    for (std::size_t n = 0; n < 15; ++n) {
        const double x = static_cast<double>(n);
        EXPECT_NEAR(weights[n], std::exp(-x * x / 50) / std::sqrt(50 * std::numbers::pi), 5e-4)
            << n; // of a peak of 0.08: the next order is 1/t
    }
}

TEST(Gaussian, two_in_a_row_are_one_of_the_summed_variance) {
    const auto both = [](double u, double v) { return [=](int, int) { return Spread{u, v}; }; };
    const Map twice = gaussian(gaussian(point(41), both(1, 0.5)), both(2, 1.5));
    const Map once = gaussian(point(41), both(3, 2));
    for (std::size_t i = 0; i < once.texels.size(); ++i)
        EXPECT_NEAR(twice.texels[i].x, once.texels[i].x, 1e-6);
}

TEST(Gaussian, keeps_a_constant_beside_a_gap) {
    Map map = point(31);
    for (glm::dvec4& texel : map.texels)
        texel = glm::dvec4(0.7);
    for (int y = 0; y < 31; ++y)
        map.valid[map.index(20, y)] = 0;
    const Map blurred = gaussian(map, [](int, int) { return Spread{4, 4}; });
    for (int x = 0; x < 31; ++x)
        EXPECT_NEAR(blurred.texels[blurred.index(x, 15)].x, x == 20 ? 0 : 0.7, 1e-12) << x;
}

TEST(SevenTaps, gain_a_thousandth_and_have_variance_1_0789) {
    const Map row = sevenTaps(point(41), true, [](int, int) { return 1.0; });
    EXPECT_NEAR(total(row), 1.001, 1e-12);
    double variance = 0;
    for (int x = 0; x < 41; ++x)
        variance += row.texels[row.index(x, 20)].x * (x - 20) * (x - 20);
    EXPECT_NEAR(variance / 1.001, 1.0789, 0.5e-4);
}

TEST(Poisson, the_printed_disc_shifts_by_a_tenth_of_its_radius_and_the_centred_one_does_not) {
    for (bool centred : {false, true}) {
        const Map blurred = poisson(point(201), [&](int, int) { return Disc{.radius = {60, 60}, .centred = centred}; });
        glm::dvec2 mean(0);
        for (int y = 0; y < 201; ++y)
            for (int x = 0; x < 201; ++x)
                mean += blurred.texels[blurred.index(x, y)].x * glm::dvec2(x - 100, y - 100);
        // A tap at +p brings the light to -p. Thirteen taps, of which the centre lies in the middle; each is rounded to a texel.
        const glm::dvec2 expected = centred ? glm::dvec2(0) : glm::dvec2(-0.0305, 0.1047) * 60.0 * 12.0 / 13.0;
        EXPECT_NEAR(mean.x, expected.x, 0.3);
        EXPECT_NEAR(mean.y, expected.y, 0.3);
    }
}

TEST(EdgeStudy, light_that_is_not_diffused) {
    const EdgeError error = edgeError([](double) { return sharpEdge(); }, kFootprint, 1);
    expectPublished(error.largest, {.357, .237, .185}, "largest");
    expectPublished(error.rms, {.073, .026, .017}, "rms");
}

TEST(EdgeStudy, row_a_the_pipeline_as_printed) {
    const EdgeError fine = errorAtEdge({.texel = 0.15});
    expectPublished(fine.largest, {.017, .029, .038}, "0.15 mm, largest");
    expectPublished(fine.rms, {.0037, .0027, .0026}, "0.15 mm, rms");
    const EdgeError coarse = errorAtEdge({.texel = 0.30});
    expectPublished(coarse.largest, {.050, .099, .129}, "0.30 mm, largest");
    expectPublished(coarse.rms, {.0063, .0106, .0129}, "0.30 mm, rms");
}

TEST(EdgeStudy, row_b_normalised_and_of_the_right_variance) {
    const EdgeError fine = errorAtEdge({.texel = 0.15, .normalised = true});
    expectPublished(fine.largest, {.016, .033, .042}, "0.15 mm, largest");
    expectPublished(fine.rms, {.0009, .0019, .0024}, "0.15 mm, rms");
    const EdgeError coarse = errorAtEdge({.texel = 0.30, .normalised = true});
    expectPublished(coarse.largest, {.044, .091, .123}, "0.30 mm, largest");
    expectPublished(coarse.rms, {.0041, .0087, .0116}, "0.30 mm, rms");
}

TEST(EdgeStudy, row_c_the_first_gaussian_left_sharp_at_each_pixel) {
    expectPublished(errorAtEdge({.texel = 0.30, .normalised = true, .sharpFirst = true}).largest, {.033, .065, .088}, "largest");
}

TEST(EdgeStudy, row_d_the_two_narrow_gaussians_exact) {
    const EdgeError fine = errorAtEdge({.texel = 0.15, .normalised = true, .exact = 2});
    expectPublished(fine.largest, {.0017, .0017, 0}, "0.15 mm, largest");
    const EdgeError coarse = errorAtEdge({.texel = 0.30, .normalised = true, .exact = 2});
    expectPublished(coarse.largest, {.0021, .0022, 0}, "0.30 mm, largest");
    expectPublished(coarse.rms, {.0004, .0004, 0}, "0.30 mm, rms");
}

TEST(EdgeStudy, six_exact_gaussians_leave_no_error) {
    EXPECT_LT(errorAtEdge({.texel = 0.30, .normalised = true, .exact = 6}).largest.r, 1e-12);
}

} // namespace tegument::reference
