// Pictures of 256 colours.
#include "tools/cli/palette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace tegument::app;

namespace {

constexpr std::size_t kSide = 128;

/// Shades of skin and more: 11,000 colours.
std::vector<std::uint8_t> shades() {
    std::vector<std::uint8_t> rgb;
    for (std::size_t y = 0; y < kSide; ++y)
        for (std::size_t x = 0; x < kSide; ++x) {
            const double u = static_cast<double>(x) / kSide, v = static_cast<double>(y) / kSide;
            for (const double value : {255 * u, 200 * u * v, 180 * v * v})
                rgb.push_back(static_cast<std::uint8_t>(std::lround(value)));
        }
    return rgb;
}

std::vector<std::uint8_t> shown(const std::vector<std::uint8_t>& numbers, const std::vector<Rgb>& palette) {
    std::vector<std::uint8_t> rgb;
    for (const std::uint8_t number : numbers)
        rgb.insert(rgb.end(), palette.at(number).begin(), palette.at(number).end());
    return rgb;
}

std::vector<std::uint8_t> nearestTo(const std::vector<std::uint8_t>& rgb, const std::vector<Rgb>& palette) {
    std::vector<std::uint8_t> numbers;
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
        const auto distance = [&](const Rgb& entry) { return std::hypot(rgb[i] - entry[0], rgb[i + 1] - entry[1], rgb[i + 2] - entry[2]); };
        numbers.push_back(static_cast<std::uint8_t>(std::ranges::min_element(palette, {}, distance) - palette.begin()));
    }
    return numbers;
}

/// The largest difference between means over squares of 8 pixels: what an eye sees from afar. Without those at the rim, where these shades
/// have their outermost colours: a palette of means has none beyond them that could make up for the rest.
double worstOfSquares(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    constexpr std::size_t kSquare = 8;
    double worst = 0;
    for (std::size_t top = kSquare; top + kSquare < kSide; top += kSquare)
        for (std::size_t left = kSquare; left + kSquare < kSide; left += kSquare)
            for (std::size_t channel = 0; channel < 3; ++channel) {
                double sum = 0;
                for (std::size_t y = top; y < top + kSquare; ++y)
                    for (std::size_t x = left; x < left + kSquare; ++x) {
                        const std::size_t at = 3 * (y * kSide + x) + channel;
                        sum += static_cast<double>(a[at]) - static_cast<double>(b[at]);
                    }
                worst = std::max(worst, std::abs(sum) / (kSquare * kSquare));
            }
    return worst;
}

} // namespace

TEST(Palette, of_a_picture_of_few_colours_is_these_colours) {
    const std::vector<std::uint8_t> rgb = {0, 0, 0, 255, 0, 0, 0, 255, 0, 9, 99, 199, 255, 0, 0, 0, 0, 0};
    const std::vector<Rgb> palette = paletteOf(rgb);
    EXPECT_EQ(palette.size(), 4U);
    EXPECT_EQ(shown(dithered(rgb, 3, palette), palette), rgb) << "nothing is lost";
}

TEST(Palette, has_at_most_256_colours_and_a_picture_of_one_colour_has_one) {
    EXPECT_EQ(paletteOf(shades()).size(), 256U);
    EXPECT_EQ(paletteOf(std::vector<std::uint8_t>(300, 77)), (std::vector<Rgb>{{77, 77, 77}}));
}

TEST(Palette, dithering_keeps_smooth_shades_on_the_mean) {
    const std::vector<std::uint8_t> rgb = shades();
    const std::vector<Rgb> palette = paletteOf(rgb);
    const double worst = worstOfSquares(shown(dithered(rgb, kSide, palette), palette), rgb);
    const double plain = worstOfSquares(shown(nearestTo(rgb, palette), palette), rgb);
    EXPECT_LT(worst, 2) << "of 255; one is usual: what a square hands to the next";
    EXPECT_LT(worst, plain / 3) << "what the nearest colour alone gives";
}

TEST(Palette, nothing_is_far_from_its_colour) {
    const std::vector<std::uint8_t> rgb = shades();
    const std::vector<Rgb> palette = paletteOf(rgb);
    const std::vector<std::uint8_t> near = shown(nearestTo(rgb, palette), palette);
    double worst = 0;
    for (std::size_t i = 0; i < rgb.size(); i += 3)
        worst = std::max(worst, std::hypot(rgb[i] - near[i], rgb[i + 1] - near[i + 1], rgb[i + 2] - near[i + 2]));
    // The surface of these shades is a sheet of about 255 x 268: 256 squares of 16 reach 12 from their middles, unevenly parted ones twice
    // that.
    EXPECT_LT(worst, 24);
}
