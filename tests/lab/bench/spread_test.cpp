// Figures of repeated measurements.

#include "lab/bench/statistics.h"

#include <gtest/gtest.h>

#include <vector>

using namespace tegument::bench;

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
