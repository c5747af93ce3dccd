// Where strands stand.

#include "meshprep/fur/fur_map.h"
#include "meshprep/fur/strand_statistics.h"
#include "meshprep/fur/strands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tegument {

namespace {

double gapOnTorus(const glm::dvec3& a, const glm::dvec3& b, double width, double height) {
    const double x = std::abs(a.x - b.x);
    const double y = std::abs(a.y - b.y);
    return std::hypot(std::min(x, width - x), std::min(y, height - y));
}

double gapOnSphere(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Every pair, no grid.
template <class Gap>
double leastGap(const StrandSet& set, Gap&& gap) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < set.strands.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            least = std::min(least, gap(set.strands[i].root, set.strands[j].root));
    return least;
}

TEST(Strands, count_is_density_times_width_times_height) {
    const auto set = strandsOnTexture(200, 100, {.density = 0.05, .spacing = 1.5});
    ASSERT_TRUE(set);
    EXPECT_EQ(set->wanted, 1000u);
    EXPECT_EQ(set->strands.size(), 1000u);
}

TEST(Strands, on_a_texture_keep_their_distance_across_its_borders) {
    const auto set = strandsOnTexture(60, 40, {.density = 0.04, .spacing = 3.5});
    ASSERT_TRUE(set);
    const double least = leastGap(*set, [](const auto& a, const auto& b) { return gapOnTorus(a, b, 60, 40); });
    EXPECT_GE(least, 3.5);
    EXPECT_LT(least, 4.2) << "random placement leaves pairs that are little further apart than they must be";
}

TEST(Strands, on_the_sphere_keep_their_distance_at_the_poles_too) {
    const std::size_t texels = 20000;
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        const auto set = strandsOnSphere(texels, {.density = 0.08, .spacing = 2.5, .seed = seed});
        ASSERT_TRUE(set);
        const double least = leastGap(*set, gapOnSphere) / std::sqrt(4 * std::numbers::pi / texels);
        EXPECT_GE(least, 2.5 * (1 - 1e-12)) << "seed " << seed;
    }
}

TEST(Strands, stand_on_the_sphere_evenly_by_area) {
    const auto set = strandsOnSphere(100000, {.density = 0.2, .spacing = 0});
    ASSERT_TRUE(set);
    const auto count = static_cast<double>(set->strands.size());
    for (const double height : {-0.9, -0.3, 0.0, 0.5, 0.95}) {
        double below = 0;
        for (const Strand& strand : set->strands)
            below += strand.root.z < height ? 1 : 0;
        const double share = (height + 1) / 2; // of the area, Archimedes
        // Four standard deviations of a binomial count.
        EXPECT_NEAR(below / count, share, 4 * std::sqrt(share * (1 - share) / count)) << "below z = " << height;
    }
}

TEST(Strands, are_the_same_for_the_same_seed_and_others_for_another) {
    const auto first = strandsOnTexture(64, 64, {.seed = 7});
    const auto again = strandsOnTexture(64, 64, {.seed = 7});
    const auto other = strandsOnTexture(64, 64, {.seed = 8});
    ASSERT_TRUE(first && again && other);
    EXPECT_EQ(first->strands.front().root, again->strands.front().root);
    EXPECT_EQ(first->strands.back().root, again->strands.back().root);
    EXPECT_NE(first->strands.front().root, other->strands.front().root);
}

TEST(Strands, that_find_no_room_are_counted_not_forced) {
    const auto set = strandsOnTexture(64, 64, {.density = 0.5, .spacing = 3});
    ASSERT_TRUE(set);
    EXPECT_EQ(set->wanted, 2048u);
    EXPECT_LT(set->strands.size(), 2048u);
    // Random placement saturates where discs of half the spacing cover 0.547 of the area (M. Tanemura, 1979); it is slow to get there.
    const double covered = static_cast<double>(set->strands.size()) * std::numbers::pi * 1.5 * 1.5 / (64.0 * 64.0);
    EXPECT_GT(covered, 0.42);
    EXPECT_LT(covered, 0.56);
}

TEST(Strands, have_lengths_from_the_shortest_to_one) {
    const auto set = strandsOnTexture(256, 256, {.shortest = 0.25});
    ASSERT_TRUE(set);
    double sum = 0;
    for (const Strand& strand : set->strands) {
        EXPECT_GE(strand.length, 0.25);
        EXPECT_LE(strand.length, 1.0);
        sum += strand.length;
    }
    const auto count = static_cast<double>(set->strands.size());
    EXPECT_NEAR(sum / count, 0.625, 4 * 0.75 / std::sqrt(12 * count)); // four deviations of an even distribution's mean
}

TEST(Strands, refuse_options_without_sense) {
    for (const FurOptions& options :
         {FurOptions{.density = 0}, FurOptions{.density = std::nan("")}, FurOptions{.spacing = -1}, FurOptions{.radius = 0.1},
          FurOptions{.shortest = 0}, FurOptions{.spacing = std::numeric_limits<double>::infinity()}}) {
        const auto set = strandsOnTexture(64, 64, options);
        ASSERT_FALSE(set);
        EXPECT_EQ(set.error().diagnostics.front().code, 7101);
    }
}

TEST(Strands, refuse_more_than_memory_should_hold) {
    const auto set = strandsOnTexture(16384, 16384, {.density = 1});
    ASSERT_FALSE(set);
    EXPECT_EQ(set.error().diagnostics.front().code, 7102);
}

TEST(StrandStatistics, agree_with_a_count_of_every_pair) {
    const auto set = strandsOnTexture(60, 40, {.density = 0.06, .spacing = 2});
    ASSERT_TRUE(set);
    const auto figures = statisticsOnTexture(*set, 60, 40);
    double sum = 0;
    for (std::size_t i = 0; i < set->strands.size(); ++i) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j < set->strands.size(); ++j)
            if (i != j) nearest = std::min(nearest, gapOnTorus(set->strands[i].root, set->strands[j].root, 60, 40));
        sum += nearest;
    }
    EXPECT_NEAR(figures.nearestMean, sum / static_cast<double>(set->strands.size()), 1e-9);
}

TEST(StrandStatistics, tell_independent_points_from_spaced_ones) {
    const auto loose = strandsOnSphere(60000, {.density = 0.08, .spacing = 0});
    const auto spaced = strandsOnSphere(60000, {.density = 0.08, .spacing = 2.2});
    ASSERT_TRUE(loose && spaced);
    const auto looseFigures = statisticsOnSphere(*loose, 60000);
    const auto spacedFigures = statisticsOnSphere(*spaced, 60000);
    // 4,800 points in 256 patches: the CV of a Poisson count, known to 1 / sqrt(2 * 256) = 4.4 % of itself; four deviations.
    EXPECT_NEAR(looseFigures.patchCv, looseFigures.poissonCv, 0.18 * looseFigures.poissonCv);
    EXPECT_NEAR(looseFigures.nearestCv, 0.523, 0.03);
    EXPECT_LT(spacedFigures.patchCv, 0.75 * spacedFigures.poissonCv);
    EXPECT_LT(spacedFigures.nearestCv, 0.3);
}

TEST(StrandStatistics, prefer_more_strands_then_evener_ones) {
    EXPECT_EQ(evenest({{.count = 10, .patchCv = 0.1}, {.count = 12, .patchCv = 0.3}, {.count = 12, .patchCv = 0.2}}), 2u);
}

/// Alpha of squares, `side` texels wide, each 0 or 1 by a coin.
Image coins(int size, int side) {
    Image map = plainImage(size, size, 4);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            map.at(x, y, 3) = (static_cast<unsigned>(x / side * 7919 + y / side * 104729) * 2654435761U) >> 31U ? 1.0F : 0.0F;
    return map;
}

TEST(HeightStatistics, of_coins_are_a_half_on_average_and_that_far_from_it) {
    const HeightStatistics heights = statisticsOfHeights(coins(512, 4));
    EXPECT_NEAR(heights.mean, 0.5, 0.03); // 16,384 coins by a hash
    EXPECT_NEAR(heights.deviation, 0.5, 0.01);
}

TEST(HeightStatistics, wider_strands_have_a_coarser_grain) {
    const double fine = statisticsOfHeights(coins(512, 3)).grain;
    const double coarse = statisticsOfHeights(coins(512, 6)).grain;
    EXPECT_GT(fine, 1);
    EXPECT_NEAR(coarse / fine, 2, 0.4); // a box of 4 sees squares of 3 and of 6 differently
}

TEST(HeightStatistics, of_a_cone_in_each_square_follow_the_law_at_other_scales) {
    FurOptions options{.density = 0.05, .spacing = 2.8, .radius = 3.4, .shortest = 0.45, .taper = true};
    const auto set = strandsOnTexture(256, 256, options);
    ASSERT_TRUE(set);
    const Image map = drawFurTexture(*set, 256, 256, options);
    const HeightStatistics heights = statisticsOfHeights(map);
    for (const int side : {2, 8}) { // the estimate comes from boxes of 4
        double within = 0;
        for (int y = 0; y < 256; y += side)
            for (int x = 0; x < 256; x += side) {
                double sum = 0;
                double squares = 0;
                for (int i = 0; i < side * side; ++i) {
                    const auto height = static_cast<double>(map.at(x + i % side, y + i / side, 3));
                    sum += height / (side * side);
                    squares += height * height / (side * side);
                }
                within += (squares - sum * sum) * side * side / (256.0 * 256.0);
            }
        const double law = (side * side - 1) / (side * side - 1 + heights.grain * heights.grain);
        EXPECT_NEAR(within / (heights.deviation * heights.deviation), law, 0.03) << side;
    }
}

TEST(HeightStatistics, where_all_is_alike_nothing_deviates) {
    Image map = coins(16, 1);
    for (std::size_t i = 3; i < map.pixels.size(); i += 4)
        map.pixels[i] = 0.5F;
    EXPECT_EQ(statisticsOfHeights(map).deviation, 0);
    EXPECT_EQ(statisticsOfHeights(map).grain, 0);
}

} // namespace

} // namespace tegument
