#pragma once
// Gauss-Legendre quadrature.

#include <cstddef>
#include <vector>

namespace tegument::reference {

struct Node {
    double x = 0;
    double weight = 0;
};

/// Nodes on [-1, 1], in rising order; exact for polynomials of degree 2 count - 1.
[[nodiscard]] std::vector<Node> gaussLegendre(std::size_t count);

/// The same on [from, to].
[[nodiscard]] std::vector<Node> gaussLegendre(std::size_t count, double from, double to);

} // namespace tegument::reference
