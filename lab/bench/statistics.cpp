#include "lab/bench/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tegument::bench {

namespace {

double medianOfEvery(std::span<const double> values, std::size_t first) {
    std::vector<double> chosen;
    for (std::size_t i = first; i < values.size(); i += 2)
        chosen.push_back(values[i]);
    return quantile(chosen, 0.5);
}

} // namespace

double quantile(std::span<const double> values, double share) {
    assert(!values.empty());
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    const double rank = std::clamp(share, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], rank - static_cast<double>(below));
}

Spread spreadOf(std::span<const double> values) {
    const double noise = values.size() < 2 ? 0 : std::abs(medianOfEvery(values, 0) - medianOfEvery(values, 1));
    return {.median = quantile(values, 0.5),
            .p5 = quantile(values, 0.05),
            .p25 = quantile(values, 0.25),
            .p75 = quantile(values, 0.75),
            .p95 = quantile(values, 0.95),
            .noise = noise};
}

PowerLaw fitPowerLaw(std::span<const double> x, std::span<const double> y) {
    assert(x.size() == y.size() && x.size() >= 2);
    const auto count = static_cast<double>(x.size());
    double meanX = 0;
    double meanY = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        meanX += std::log(x[i]) / count;
        meanY += std::log(y[i]) / count;
    }
    double covariance = 0;
    double variance = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        covariance += (std::log(x[i]) - meanX) * (std::log(y[i]) - meanY);
        variance += (std::log(x[i]) - meanX) * (std::log(x[i]) - meanX);
    }
    PowerLaw law{.exponent = covariance / variance, .factor = 0};
    law.factor = std::exp(meanY - law.exponent * meanX);
    for (std::size_t i = 0; i < x.size(); ++i)
        law.worst = std::max(law.worst, std::abs(std::log(y[i] / (law.factor * std::pow(x[i], law.exponent)))));
    return law;
}

AffineLaw fitAffine(std::span<const double> x, std::span<const double> y) {
    assert(x.size() == y.size() && x.size() >= 2);
    // Minimises the sum of (fixed / y + slope x / y - 1)^2: two unknowns, normal equations.
    double a = 0;
    double b = 0;
    double c = 0;
    double right = 0;
    double rightX = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double u = 1 / y[i];
        const double v = x[i] / y[i];
        a += u * u;
        b += u * v;
        c += v * v;
        right += u;
        rightX += v;
    }
    const double determinant = a * c - b * b;
    AffineLaw law{.fixed = (right * c - rightX * b) / determinant, .slope = (a * rightX - b * right) / determinant};
    for (std::size_t i = 0; i < x.size(); ++i)
        law.worst = std::max(law.worst, std::abs(y[i] / (law.fixed + law.slope * x[i]) - 1));
    return law;
}

} // namespace tegument::bench
