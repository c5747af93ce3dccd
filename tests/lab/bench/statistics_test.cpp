// Laws through measured times.
// Figures of repeated measurements.
// How far a picture is from the truth, where the answer is known.

#include "lab/bench/measure.h"
#include "lab/bench/statistics.h"
#include "lab/bench/textures.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

using namespace tegument::bench;
using namespace tegument;

namespace {

constexpr std::array kSizes = {1.0, 4.0, 16.0, 64.0};

template <class Function>
std::vector<double> times(Function function) {
    std::vector<double> y;
    for (const double x : kSizes)
        y.push_back(function(x));
    return y;
}

constexpr int kSide = 10;

/// Every pixel of a picture, the left half of it interior.
Sample everyPixel() {
    Sample sample;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            sample.points.push_back({.x = x, .y = y});
            sample.interior.push_back(x < kSide / 2 ? 1 : 0);
        }
    return sample;
}

Image grey(float value) {
    return plainImage(kSide, kSide, 4, value);
}

std::vector<glm::dvec3> light(double value) {
    return std::vector<glm::dvec3>(kSide * kSide, glm::dvec3(value));
}

} // namespace

TEST(PowerLaws, find_the_exponent_of_a_power) {
    const PowerLaw law = fitPowerLaw(kSizes, times([](double x) { return 3 * std::pow(x, 0.75); }));
    EXPECT_NEAR(law.exponent, 0.75, 1e-12);
    EXPECT_NEAR(law.factor, 3, 1e-12);
    EXPECT_NEAR(law.worst, 0, 1e-12);
}

TEST(PowerLaws, a_fixed_cost_lowers_the_exponent) {
    EXPECT_LT(fitPowerLaw(kSizes, times([](double x) { return 5 + x; })).exponent, 0.7);
}

TEST(AffineLaws, tell_the_fixed_cost_from_the_cost_of_a_unit) {
    const AffineLaw law = fitAffine(kSizes, times([](double x) { return 5 + 0.25 * x; }));
    EXPECT_NEAR(law.fixed, 5, 1e-10);
    EXPECT_NEAR(law.slope, 0.25, 1e-12);
    EXPECT_NEAR(law.worst, 0, 1e-12);
}

TEST(AffineLaws, weigh_small_sizes_like_large_ones) {
    auto y = times([](double x) { return x; });
    y[3] *= 1.1; // one time is 10 % off: absolute least squares would let it bend the rest
    const AffineLaw law = fitAffine(kSizes, y);
    EXPECT_NEAR((law.fixed + law.slope) / y[0], 1, 0.02);
}

TEST(Quantiles, are_linear_between_ranks) {
    const std::vector<double> values = {40, 10, 30, 20};
    EXPECT_DOUBLE_EQ(quantile(values, 0), 10);
    EXPECT_DOUBLE_EQ(quantile(values, 0.5), 25);
    EXPECT_DOUBLE_EQ(quantile(values, 1), 40);
    EXPECT_NEAR(quantile(values, 0.05), 11.5, 1e-12);
}

TEST(Quantiles, of_one_value_are_that_value) {
    EXPECT_DOUBLE_EQ(quantile(std::vector{7.0}, 0.95), 7);
}

TEST(Spreads, of_1_to_101_are_known) {
    std::vector<double> values;
    for (int i = 101; i >= 1; --i)
        values.push_back(i);
    const Spread spread = spreadOf(values);
    EXPECT_DOUBLE_EQ(spread.median, 51);
    EXPECT_DOUBLE_EQ(spread.p5, 6);
    EXPECT_DOUBLE_EQ(spread.p95, 96);
}

TEST(Spreads, noise_is_what_every_other_frame_changes) {
    EXPECT_DOUBLE_EQ(spreadOf(std::vector{1.0, 3.0, 1.0, 3.0}).noise, 2);
    EXPECT_DOUBLE_EQ(spreadOf(std::vector{2.0, 2.0, 2.0}).noise, 0);
}

TEST(Errors, of_a_picture_that_is_too_bright_by_a_tenth_are_a_tenth) {
    const auto errors = errorsOf(grey(0.55F), everyPixel(), light(0.5));
    ASSERT_TRUE(errors);
    EXPECT_NEAR(errors->relativeL2, 0.1, 1e-6);
    EXPECT_NEAR(errors->bias, 0.1, 1e-6);
    EXPECT_NEAR(errors->p99, 0.1, 1e-6);
    EXPECT_NEAR(errors->psnr, 20, 1e-4) << "10 log10(0.5^2 / 0.05^2)";
}

TEST(Errors, at_outlines_are_not_interior) {
    Image picture = grey(0.5F);
    picture.at(9, 0, 1) = 1; // right half: not interior
    picture.at(0, 0, 1) = 0.55F;
    const auto errors = errorsOf(picture, everyPixel(), light(0.5));
    ASSERT_TRUE(errors);
    EXPECT_NEAR(errors->largestInterior, 0.1, 1e-6);
    EXPECT_NEAR(errors->relativeL2, std::sqrt((0.25 + 0.0025) / (300 * 0.25)), 1e-6) << "they count in the norm";
}

TEST(Errors, of_what_is_not_finite_are_an_error) {
    Image picture = grey(0.5F);
    picture.at(3, 3, 0) = std::nanf("");
    const auto errors = errorsOf(picture, everyPixel(), light(0.5));
    ASSERT_FALSE(errors);
    EXPECT_EQ(errors.error().diagnostics.front().code, 5261);
}

TEST(Textures, halves_are_means_of_light_not_of_its_encoding) {
    const Image image{
        .width = 2, .height = 2, .channels = 4, .pixels = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1}, .bitsPerChannel = 8};
    const Image half = halved(image, MeanOf::Light);
    ASSERT_EQ(half.width, 1);
    EXPECT_NEAR(half.at(0, 0, 0), 0.7354, 1e-3) << "sRGB of 1/2";
    EXPECT_FLOAT_EQ(half.at(0, 0, 3), 0.5F) << "alpha is no light";
    EXPECT_FLOAT_EQ(halved(image, MeanOf::Values).at(0, 0, 0), 0.5F);
}

TEST(Textures, a_pixel_s_step_is_counted_in_texels) {
    std::vector<reference::ShadedPoint> points;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            points.push_back({.x = x, .y = y, .point = {.uv = {x * 0.01, y * 0.005}}});
    EXPECT_NEAR(texelsPerPixel(points, 200), 2, 1e-9);
}
