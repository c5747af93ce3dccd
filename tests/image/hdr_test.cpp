// Radiance's pictures, written here byte by byte.

#include "host/image/image.h"

#include <gtest/gtest.h>

#include <span>
#include <string>

namespace tegument::test {

namespace {

constexpr const char* kHead = "#?RADIANCE\nEXPOSURE=1\nFORMAT=32-bit_rle_rgbe\n\n";

Result<Image> read(const std::string& bytes) {
    return decodeImage(std::as_bytes(std::span(bytes)), "test.hdr");
}

int codeOf(const Result<Image>& image) {
    return image ? 0 : image.error().diagnostics.front().code;
}

std::string bytes(std::initializer_list<int> values) {
    std::string text;
    for (const int value : values)
        text += static_cast<char>(value);
    return text;
}

/// One row of eight pixels in runs: red 128 for all, green 1 to 8, blue 0, exponent 129 (times 2^-7) for all.
std::string runs() {
    return std::string(kHead) + "-Y 1 +X 8\n" +
           bytes({2, 2, 0, 8, 128 + 8, 128, 8, 1, 2, 3, 4, 5, 6, 7, 8, 128 + 8, 0, 128 + 4, 129, 128 + 4, 129});
}

TEST(Hdr, plain_pixels_are_mantissa_times_a_power_of_two) {
    const auto image = read(std::string(kHead) + "-Y 2 +X 1\n" + bytes({128, 64, 0, 129, 200, 100, 50, 136 + 3}));
    ASSERT_TRUE(image) << format(image.error());
    EXPECT_EQ(image->width, 1);
    EXPECT_EQ(image->height, 2);
    EXPECT_EQ(image->pixels, (std::vector<float>{1, 0.5F, 0, 1600, 800, 400}));
}

TEST(Hdr, an_exponent_of_zero_is_black) {
    const auto image = read(std::string(kHead) + "-Y 1 +X 1\n" + bytes({200, 100, 50, 0}));
    ASSERT_TRUE(image) << format(image.error());
    EXPECT_EQ(image->pixels, (std::vector<float>{0, 0, 0}));
}

TEST(Hdr, runs_are_unfolded_channel_by_channel) {
    const auto image = read(runs());
    ASSERT_TRUE(image) << format(image.error());
    for (int x = 0; x < 8; ++x) {
        EXPECT_EQ(image->at(x, 0, 0), 1.0F);
        EXPECT_EQ(image->at(x, 0, 1), static_cast<float>(x + 1) / 128);
        EXPECT_EQ(image->at(x, 0, 2), 0.0F);
    }
}

TEST(Hdr, every_cut_is_an_error_with_its_byte) {
    const std::string whole = runs();
    for (std::size_t size = 11; size < whole.size(); ++size) {
        const auto image = read(whole.substr(0, size));
        EXPECT_EQ(codeOf(image), 5201) << size;
        ASSERT_FALSE(image);
        EXPECT_EQ(image.error().diagnostics.front().at.byte, size) << format(image.error());
    }
}

TEST(Hdr, a_run_beyond_its_row_or_of_nothing_is_damage) {
    std::string tooLong = runs();
    const std::size_t first = tooLong.find(bytes({2, 2, 0, 8})) + 4;
    tooLong[first] = static_cast<char>(128 + 9);
    EXPECT_EQ(codeOf(read(tooLong)), 5202);
    tooLong[first] = 0;
    EXPECT_EQ(codeOf(read(tooLong)), 5202);
}

TEST(Hdr, other_kinds_are_named) {
    EXPECT_EQ(codeOf(read("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + bytes({1, 2, 3, 4}))), 5204);
    EXPECT_EQ(codeOf(read(std::string(kHead) + "+X 1 -Y 1\n" + bytes({1, 2, 3, 4}))), 5204);
    EXPECT_EQ(codeOf(read(std::string(kHead) + "-Y 0 +X 1\n")), 5203);
    EXPECT_EQ(codeOf(read(std::string(kHead) + "-Y 1 +X 999999999999\n")), 5203);
}

} // namespace

} // namespace tegument::test
