// What stands under the cursor, and how values are spread.

#include "tools/view/panel.h"
#include "tools/view/probe.h"
#include "tools/view/state.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace tegument::view {

namespace {

Image ramp(int width, int height, int channels) {
    Image image{.width = width, .height = height, .channels = channels, .pixels = {}, .metadata = {}};
    for (int i = 0; i < width * height * channels; ++i)
        image.pixels.push_back(static_cast<float>(i + 1));
    return image;
}

} // namespace

TEST(Probe, finds_the_place_on_a_picture_that_is_fitted_into_the_window) {
    // 100 x 50 in 200 x 200: it stands from 50 to 150 of the height.
    const auto middle = placeOnPicture({0.5, 0.5}, {100, 50}, {200, 200});
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->x, 0.5, 1e-12);
    EXPECT_NEAR(middle->y, 0.5, 1e-12);
    const auto top = placeOnPicture({0.25, 0.25}, {100, 50}, {200, 200});
    ASSERT_TRUE(top);
    EXPECT_NEAR(top->x, 0.25, 1e-12);
    EXPECT_NEAR(top->y, 0, 1e-12);
    EXPECT_FALSE(placeOnPicture({0.5, 0.2}, {100, 50}, {200, 200})) << "above it";
    EXPECT_FALSE(placeOnPicture({-0.1, 0.5}, {100, 100}, {200, 200})) << "outside the window";
    EXPECT_FALSE(placeOnPicture({0.5, 0.5}, {0, 50}, {200, 200}));
    EXPECT_FALSE(placeOnPicture({0.5, 0.5}, {100, 50}, {0, 0})) << "an iconified window";
}

TEST(Probe, tells_the_texel_and_its_values_the_shown_target_first) {
    const Image picture = ramp(4, 2, 3);
    const Image depth = ramp(8, 4, 1);
    const auto lines =
        probeLines({probedTexel("", picture, {0.625, 0.5}), probedTexel("gDepth", depth, {0.625, 0.5})}, "gDepth", {0.625, 0.5});
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0], "at 0.6250, 0.5000");
    EXPECT_EQ(lines[1].substr(0, 6), "gDepth");
    EXPECT_NE(lines[1].find("5,   2"), std::string::npos) << lines[1];
    EXPECT_NE(lines[1].find(" 22"), std::string::npos) << lines[1]; // 2 * 8 + 5, counted from 1
    EXPECT_EQ(lines[2].substr(0, 7), "picture");
    EXPECT_NE(lines[2].find("19       20       21"), std::string::npos) << lines[2]; // texel (2, 1): 3 * (4 + 2) + 1
}

TEST(Probe, its_last_texel_is_the_last) {
    const Image picture = ramp(2, 2, 1);
    EXPECT_NE(probeLines({probedTexel("", picture, {1, 1})}, "", {1, 1})[1].find("1,   1"), std::string::npos);
}

TEST(Spread, counts_each_written_texel_once_and_leaves_out_what_is_not_finite) {
    Image image = ramp(8, 8, 1);
    image.pixels[3] = 0; // nothing was drawn there
    image.pixels[5] = std::numeric_limits<float>::quiet_NaN();
    image.pixels[6] = std::numeric_limits<float>::infinity();
    const Histogram histogram = histogramOf(image);
    EXPECT_EQ(histogram.low, 1);
    EXPECT_EQ(histogram.high, 64);
    EXPECT_EQ(histogram.notFinite, 2U);
    EXPECT_EQ(std::accumulate(histogram.counts[0].begin(), histogram.counts[0].end(), std::size_t{0}), 61U);
    EXPECT_EQ(histogram.counts[0].back(), 1U) << "the largest value";
}

TEST(Spread, leaves_alpha_out) {
    const Histogram histogram =
        histogramOf({.width = 2, .height = 1, .channels = 4, .pixels = {0.1F, 0.2F, 0.3F, 9, 0, 0, 0, 1}, .metadata = {}});
    EXPECT_EQ(histogram.channels, 3);
    EXPECT_EQ(histogram.low, 0.1F) << "the second texel is not written";
    EXPECT_EQ(histogram.high, 0.3F);
}

TEST(Spread, of_nothing_or_of_one_value_is_fine) {
    EXPECT_EQ(histogramOf({.width = 0, .height = 0, .channels = 3, .pixels = {}, .metadata = {}}).high, 0);
    const Histogram one = histogramOf({.width = 2, .height = 1, .channels = 1, .pixels = {7, 7}, .metadata = {}});
    EXPECT_EQ(one.counts[0][0], 2U);
    EXPECT_EQ(one.low, one.high);
}

TEST(Strip, opens_a_target_or_the_picture_and_nothing_else) {
    ViewState state;
    state.targets = {"gA", "gB"};
    state.stops = 2;
    EXPECT_EQ(showTarget(state, "gB"), Request::Draw);
    EXPECT_EQ(state.show, Show::Target);
    EXPECT_EQ(state.target, "gB");
    EXPECT_EQ(state.stops, 0) << "its own exposure";
    EXPECT_EQ(showTarget(state, "gone"), Request::None);
    EXPECT_EQ(state.target, "gB");
    EXPECT_EQ(showTarget(state, ""), Request::Draw);
    EXPECT_EQ(state.show, Show::Picture);
}

} // namespace tegument::view
