// The convolutions of the references: laws of a Gaussian on a grid, and the printed kernels' own figures.

#include "lab/reference/convolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace tegument::reference;

namespace {

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
