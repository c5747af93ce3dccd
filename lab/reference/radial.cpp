#include "lab/reference/radial.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::reference {

namespace {

/// Integral of K0 from x >= 0 to infinity, = integral of exp(-x cosh u) / cosh u over u > 0: analytic and even, so that the trapezoidal
/// rule converges exponentially.
double besselTail(double x) {
    constexpr double kStep = 0.05;
    double sum = 0.5 * std::exp(-x);
    constexpr int kSteps = 800; // to u = 40
    for (int i = 1; i < kSteps; ++i)
        sum += std::exp(-x * std::cosh(i * kStep)) / std::cosh(i * kStep);
    return sum * kStep;
}

struct Legendre {
    double value = 0;
    double derivative = 0;
};

Legendre legendre(std::size_t degree, double x) {
    double before = 1;
    double value = x;
    for (std::size_t k = 2; k <= degree; ++k) {
        const auto n = static_cast<double>(k);
        const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
        before = value;
        value = next;
    }
    const auto n = static_cast<double>(degree);
    return {value, n * (x * value - before) / (x * x - 1)};
}

} // namespace

RadialProfile radial(const Profile& gaussians, const glm::dvec3& flesh) {
    constexpr double kReach = 6; // sigma
    const auto [narrowest, widest] = std::ranges::minmax(gaussians, {}, &Gaussian::variance);
    const auto density = [gaussians](double distance) {
        glm::dvec3 sum(0);
        for (const Gaussian& g : gaussians)
            sum += g.weight * (std::exp(-distance * distance / (2 * g.variance)) / (2 * std::numbers::pi * g.variance));
        return sum;
    };
    return {density, kReach * std::sqrt(widest.variance), std::sqrt(narrowest.variance), flesh};
}

RadialProfile burley(const glm::dvec3& d) {
    constexpr double kReach = 30;         // d: 3/4 exp(-10) is left out
    constexpr double kFinest = 2e-4;      // d: 1e-4 of the energy lies within, for the share grows as r / (2 d) there
    static constexpr double kZero = 1e-9; // d: nearer, 1/r is cut off
    const auto density = [d](double distance) {
        glm::dvec3 value;
        for (int c = 0; c < 3; ++c) {
            const double x = std::max(distance / d[c], kZero);
            value[c] = (std::exp(-x) + std::exp(-x / 3)) / (8 * std::numbers::pi * d[c] * d[c] * x);
        }
        return value;
    };
    return {density, kReach * std::max({d.x, d.y, d.z}), kFinest * std::min({d.x, d.y, d.z}), glm::dvec3(0)};
}

glm::dvec3 burleyWithin(const glm::dvec3& d, double distance) {
    return 1.0 - 0.25 * glm::exp(-distance / d) - 0.75 * glm::exp(-distance / (3.0 * d));
}

glm::dvec3 burleyHalfPlane(const glm::dvec3& d, double x) {
    // A line of light spreads as (K0(|x|/d) + K0(|x|/(3d))) / (4 pi d).
    glm::dvec3 value;
    for (int c = 0; c < 3; ++c) {
        const double beyond = (besselTail(std::abs(x) / d[c]) + 3 * besselTail(std::abs(x) / (3 * d[c]))) / (4 * std::numbers::pi);
        value[c] = x >= 0 ? 1 - beyond : beyond;
    }
    return value;
}

std::vector<Node> gaussLegendre(std::size_t count) {
    constexpr int kNewtonSteps = 8; // quadratic from a start within 1e-2: four would do
    std::vector<Node> nodes(count);
    for (std::size_t i = 0; i < count; ++i) {
        // Tricomi's estimate of the root, counted from the right end.
        double x = std::cos(std::numbers::pi * (static_cast<double>(count - i) - 0.25) / (static_cast<double>(count) + 0.5));
        for (int step = 0; step < kNewtonSteps && count > 1; ++step) {
            const Legendre p = legendre(count, x);
            x -= p.value / p.derivative;
        }
        if (count == 1) x = 0;
        const double derivative = count == 1 ? 1 : legendre(count, x).derivative;
        nodes[i] = {x, 2 / ((1 - x * x) * derivative * derivative)};
    }
    return nodes;
}

std::vector<Node> gaussLegendre(std::size_t count, double from, double to) {
    std::vector<Node> nodes = gaussLegendre(count);
    const double half = 0.5 * (to - from);
    for (Node& node : nodes)
        node = {from + half * (node.x + 1), half * node.weight};
    return nodes;
}

} // namespace tegument::reference
