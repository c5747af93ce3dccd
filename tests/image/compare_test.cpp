#include "host/image/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace tegument;

namespace {

/// Every value 2 but for those that a test changes.
Image twos(int width = 10, int height = 10, int channels = 4) {
    return {.width = width,
            .height = height,
            .channels = channels,
            .pixels = std::vector<float>(static_cast<std::size_t>(width * height * channels), 2.0F),
            .metadata = {}};
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
