// Laws through measured times.

#include "lab/bench/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

using namespace tegument::bench;

namespace {

constexpr std::array kSizes = {1.0, 4.0, 16.0, 64.0};

template <class Function>
std::vector<double> times(Function function) {
    std::vector<double> y;
    for (const double x : kSizes)
        y.push_back(function(x));
    return y;
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

TEST(AffineLaws, explain_the_exponent_that_a_fixed_cost_leaves) {
    const auto y = times([](double x) { return 5 + x; });
    const AffineLaw law = fitAffine(kSizes, y);
    EXPECT_NEAR(law.exponentAt(8), 8.0 / 13, 1e-10);
    EXPECT_NEAR(law.exponentAt(1e9), 1, 1e-8);
}
