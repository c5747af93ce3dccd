#include "host/image/compare.h"
#include "host/image/mips.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace tegument;

namespace {

/// Every value 2 but for those that a test changes.
Image twos(int width = 10, int height = 10, int channels = 4) {
    return {.width = width,
            .height = height,
            .channels = channels,
            .pixels = std::vector<float>(static_cast<std::size_t>(width * height * channels), 2.0F)};
}

/// Eight bits without a pattern.
Image noise(int width, int height, int channels) {
    std::mt19937 random(7);
    Image image{.width = width, .height = height, .channels = channels, .bitsPerChannel = 8};
    for (int i = 0; i < width * height * channels; ++i)
        image.pixels.push_back(static_cast<float>(random() % 256) / 255);
    return image;
}

/// Of what a texel of a level covers, where every side is a power of two; `encoded`: of the light, and encoded again.
double meanBelow(const Image& image, int level, int x, int y, int channel, bool encoded) {
    const int side = 1 << level;
    double sum = 0;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const double value = static_cast<double>(image.at(side * x + i, side * y + j, channel));
            sum += !encoded ? value : value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
        }
    const double mean = sum / side / side;
    return !encoded ? mean : mean <= 0.0031308 ? 12.92 * mean : 1.055 * std::pow(mean, 1 / 2.4) - 0.055;
}

void expectMeans(const Image& image, MeanOf mean) {
    const std::vector<Image> levels = mipLevels(image, mean);
    ASSERT_EQ(levels.size(), 5U);
    for (int level = 1; level <= 5; ++level) {
        const Image& made = levels[static_cast<std::size_t>(level - 1)];
        ASSERT_EQ(made.width, image.width >> level);
        for (int y = 0; y < made.height; ++y)
            for (int x = 0; x < made.width; ++x)
                for (int c = 0; c < made.channels; ++c)
                    ASSERT_NEAR(static_cast<double>(made.at(x, y, c)), meanBelow(image, level, x, y, c, mean == MeanOf::Light && c != 3),
                                2e-6)
                        << "level " << level << ", channel " << c;
    }
}

} // namespace

TEST(Compare, a_picture_does_not_differ_from_itself) {
    const auto difference = compareImages(twos(), twos());
    ASSERT_TRUE(difference);
    EXPECT_EQ(difference->largest, 0);
    EXPECT_EQ(difference->relativeL2, 0);
    EXPECT_EQ(difference->pixelsBeyond, 0u);
}

TEST(Compare, one_changed_value_is_found_and_weighed) {
    Image changed = twos();
    changed.at(3, 7, 1) = 3.0F;
    const auto difference = compareImages(changed, twos());
    ASSERT_TRUE(difference);
    EXPECT_DOUBLE_EQ(difference->largest, 0.5);
    EXPECT_EQ(difference->largestX, 3);
    EXPECT_EQ(difference->largestY, 7);
    EXPECT_EQ(difference->pixelsBeyond, 1u);
    EXPECT_DOUBLE_EQ(difference->beyond, 0.01);
    EXPECT_DOUBLE_EQ(difference->bias, 0.5 / 300);
    EXPECT_DOUBLE_EQ(difference->relativeL2, std::sqrt(1.0 / (300 * 4.0)));
    EXPECT_EQ(difference->p99, 0);
}

TEST(Compare, alpha_does_not_count) {
    Image changed = twos();
    changed.at(0, 0, 3) = 100.0F;
    EXPECT_EQ(compareImages(changed, twos())->largest, 0);
}

TEST(Compare, a_limit_counts_pixels_not_values) {
    Image changed = twos();
    for (int c = 0; c < 3; ++c)
        changed.at(0, 0, c) = 2.1F;
    EXPECT_EQ(compareImages(changed, twos(), 0.01)->pixelsBeyond, 1u);
    EXPECT_EQ(compareImages(changed, twos(), 0.06)->pixelsBeyond, 0u);
}

TEST(Compare, what_cannot_be_compared_is_an_error) {
    EXPECT_FALSE(compareImages(twos(10, 10), twos(10, 9)));
    EXPECT_FALSE(compareImages(twos(4, 4, 1), twos(4, 4, 3)));
    Image black = twos();
    black.pixels.assign(black.pixels.size(), 0.0F);
    EXPECT_FALSE(compareImages(twos(), black));
    Image broken = twos();
    broken.at(5, 5, 0) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(compareImages(broken, twos()));
}

TEST(Compare, the_difference_picture_shows_where) {
    Image changed = twos();
    changed.at(3, 7, 1) = 1.0F;
    const Image difference = differenceImage(changed, twos());
    EXPECT_FLOAT_EQ(difference.at(3, 7, 1), 0.5F);
    EXPECT_EQ(difference.at(3, 6, 1), 0.0F);
}

/// Floats' rounding alone: a level that was rounded to eight bits before the next is up to 0.002 off.
TEST(MipLevels, are_means_of_the_image_itself) {
    expectMeans(noise(32, 32, 4), MeanOf::Values);
}

TEST(MipLevels, of_srgb_are_means_of_its_light_but_for_alpha) {
    expectMeans(noise(32, 32, 4), MeanOf::Light);
}

TEST(MipLevels, lose_no_texel_of_odd_sides) {
    for (const auto& [width, height] : {std::pair(7, 5), std::pair(1, 13), std::pair(9, 1), std::pair(3, 3)}) {
        const Image image = noise(width, height, 1);
        double sum = 0;
        for (const float value : image.pixels)
            sum += static_cast<double>(value);
        const std::vector<Image> levels = mipLevels(image, MeanOf::Values);
        ASSERT_FALSE(levels.empty());
        ASSERT_EQ(levels.back().pixels.size(), 1U);
        EXPECT_NEAR(static_cast<double>(levels.back().pixels[0]), sum / width / height, 1e-6) << width << " x " << height;
    }
}

TEST(MipLevels, of_one_texel_are_none) {
    EXPECT_TRUE(mipLevels(noise(1, 1, 4), MeanOf::Light).empty());
}

TEST(MipLevels, of_two_channels_have_their_alpha_in_the_second) {
    const Image image{.width = 2, .height = 1, .channels = 2, .pixels = {0, 0, 1, 1}, .bitsPerChannel = 8};
    const Image half = mipLevels(image, MeanOf::Light).front();
    EXPECT_NEAR(half.at(0, 0, 0), 0.7354F, 1e-4F) << "sRGB of 1/2";
    EXPECT_EQ(half.at(0, 0, 1), 0.5F);
}
