#pragma once
// Figures of repeated measurements, and the power law through a few of them.

#include <span>
#include <vector>

namespace tegument::bench {

/// Quantile of unsorted values, linear between ranks: 0 the smallest, 1 the largest. At least one value.
[[nodiscard]] double quantile(std::span<const double> values, double share);

struct Spread {
    double median = 0;
    double p5 = 0;
    double p25 = 0;
    double p75 = 0;
    double p95 = 0;
    double noise = 0; // medians of the even and of the odd values apart: what repeating the measurement changes
};
[[nodiscard]] Spread spreadOf(std::span<const double> values);

/// y = factor * x^exponent by least squares in logarithms.
struct PowerLaw {
    double exponent = 0;
    double factor = 0;
    double worst = 0; // largest |log(y / fit)|
};
/// At least two points, all positive, not all at one x.
[[nodiscard]] PowerLaw fitPowerLaw(std::span<const double> x, std::span<const double> y);

/// y = fixed + slope * x by least squares of relative errors, so that small sizes count as much as large ones.
struct AffineLaw {
    double fixed = 0;
    double slope = 0;
    double worst = 0; // largest |y / fit - 1|
};
/// At least two points, all positive, not all at one x.
[[nodiscard]] AffineLaw fitAffine(std::span<const double> x, std::span<const double> y);

} // namespace tegument::bench
