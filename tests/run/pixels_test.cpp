#include "host/run/pixels.h"
#include "tests/run/fixture.h"

#include <cstring>

namespace tegument::run {
namespace {

Image onePixel(std::vector<float> channels, int bits) {
    const auto count = static_cast<int>(channels.size());
    Image image{.width = 1, .height = 1, .channels = count, .pixels = std::move(channels)};
    image.bitsPerChannel = bits;
    return image;
}

TEST(Pixels, eight_bit_srgb_files_are_left_to_the_sampler) {
    EXPECT_EQ(formatFor(onePixel({0, 0, 0}, 8), true), gpu::Format::RGBA8Srgb);
    EXPECT_EQ(formatFor(onePixel({0, 0, 0}, 8), false), gpu::Format::RGBA8);
}

TEST(Pixels, float_files_keep_their_floats) {
    EXPECT_EQ(formatFor(onePixel({0, 0, 0}, 32), true), gpu::Format::RGBA32F);
}

TEST(Pixels, grey_is_spread_and_alpha_filled) {
    const auto bytes = texels(onePixel({0.5F}, 32), gpu::Format::RGBA32F, false);
    EXPECT_TRUE(test::pixelIs(imageFrom(bytes, 1, 1, gpu::Format::RGBA32F), 0, 0, {0.5F, 0.5F, 0.5F, 1}));
}

TEST(Pixels, two_channels_stay_two_in_every_pixel) {
    const Image image{.width = 3, .height = 1, .channels = 2, .pixels = {0.25F, 1, 0.5F, 2, 0.75F, 3}};
    const auto bytes = texels(image, gpu::Format::RG32F, false);
    ASSERT_EQ(bytes.size(), 6 * sizeof(float));
    EXPECT_EQ(std::memcmp(bytes.data(), image.pixels.data(), bytes.size()), 0);
}

TEST(Pixels, decoding_leaves_alpha_alone) {
    const auto bytes = texels(onePixel({0.5F, 0.5F, 0.5F, 0.5F}, 16), gpu::Format::RGBA32F, true);
    const Image image = imageFrom(bytes, 1, 1, gpu::Format::RGBA32F);
    EXPECT_TRUE(test::pixelIs(image, 0, 0, {srgbToLinear(0.5F), srgbToLinear(0.5F), srgbToLinear(0.5F), 0.5F}));
}

TEST(Pixels, every_half_that_is_finite_survives_a_round_trip) {
    for (std::uint32_t bits = 0; bits < 65536; ++bits) {
        if ((bits & 0x7C00U) == 0x7C00U) continue; // infinities and NaN
        const auto half = static_cast<std::uint16_t>(bits);
        std::vector<std::byte> texel(2);
        std::memcpy(texel.data(), &half, 2);
        EXPECT_EQ(texels(imageFrom(texel, 1, 1, gpu::Format::R16F), gpu::Format::R16F, false), texel) << bits;
    }
}

TEST(Pixels, blue_and_red_are_swapped_for_A8R8G8B8) {
    const std::vector<std::byte> bgra = {std::byte{255}, std::byte{51}, std::byte{0}, std::byte{102}};
    EXPECT_TRUE(test::pixelIs(imageFrom(bgra, 1, 1, gpu::Format::BGRA8), 0, 0, {0, 0.2F, 1, 0.4F}, 1e-7F)); // one float rounding
}

TEST(Pixels, ten_bit_channels_have_red_in_the_low_bits) {
    const std::uint32_t packed = 1023U | 3U << 30;
    std::vector<std::byte> texel(4);
    std::memcpy(texel.data(), &packed, 4);
    EXPECT_TRUE(test::pixelIs(imageFrom(texel, 1, 1, gpu::Format::RGB10A2), 0, 0, {1, 0, 0, 1}));
}

} // namespace
} // namespace tegument::run
