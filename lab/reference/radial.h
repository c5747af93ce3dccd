#pragma once
// Diffusion profiles as functions of the distance: what leaves per mm^2 at that distance from where unit light entered.
// Gauss-Legendre quadrature.

#include "lab/reference/profile.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace tegument::reference {

struct RadialProfile {
    std::function<glm::dvec3(double distance)> density; // per mm^2; called from several threads
    double reach = 0;                                   // mm beyond which it counts as 0
    double finest = 0;                                  // mm within which it is smooth, or holds too little to matter
    glm::dvec3 flesh{0};                                // c, per mm: how much more passes with flesh under the way (bssrdf.h)
};

/// Reach: six sigma of the widest, where 1.5e-8 of it is left out.
[[nodiscard]] RadialProfile radial(const Profile& gaussians, const glm::dvec3& flesh = glm::dvec3(0));

/// Burley's normalised diffusion (Christensen and Burley 2015) with albedo 1: R = (exp(-r/d) + exp(-r/(3d))) / (8 pi d r), d in mm for each
/// channel. Reach: 3e-5 of the widest is left out.
[[nodiscard]] RadialProfile burley(const glm::dvec3& d);
/// Its share within this distance: 1 - exp(-r/d)/4 - 3 exp(-r/(3d))/4.
[[nodiscard]] glm::dvec3 burleyWithin(const glm::dvec3& d, double distance);
/// Light on x > 0 of a plane, seen at x.
[[nodiscard]] glm::dvec3 burleyHalfPlane(const glm::dvec3& d, double x);

struct Node {
    double x = 0;
    double weight = 0;
};

/// Nodes on [-1, 1], in rising order; exact for polynomials of degree 2 count - 1.
[[nodiscard]] std::vector<Node> gaussLegendre(std::size_t count);

/// The same on [from, to].
[[nodiscard]] std::vector<Node> gaussLegendre(std::size_t count, double from, double to);

} // namespace tegument::reference
