#include "lab/reference/quadrature.h"

#include <cmath>
#include <numbers>

namespace tegument::reference {

namespace {

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
