// How far a picture is from the truth, where the answer is known.

#include "lab/bench/measure.h"
#include "lab/bench/textures.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace tegument;
using namespace tegument::bench;

namespace {

constexpr int kSide = 10;

/// Every pixel of a picture, the left half of it interior.
Sample everyPixel() {
    Sample sample;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            sample.points.push_back({.x = x, .y = y, .point = {}});
            sample.interior.push_back(x < kSide / 2 ? 1 : 0);
        }
    return sample;
}

Image grey(float value) {
    Image image{.width = kSide, .height = kSide, .channels = 4, .pixels = {}, .metadata = {}};
    image.pixels.assign(kSide * kSide * 4, value);
    return image;
}

std::vector<glm::dvec3> light(double value) {
    return std::vector<glm::dvec3>(kSide * kSide, glm::dvec3(value));
}

} // namespace

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
    const Image image{.width = 2,
                      .height = 2,
                      .channels = 4,
                      .pixels = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1},
                      .bitsPerChannel = 8,
                      .metadata = {}};
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
