#pragma once
// For algorithms that work in single precision: their squares and reciprocals neither vanish nor overflow at unit size.

#include "host/mesh/extent.h"

#include <cmath>

namespace tegument::prep {

/// Positions moved into the unit box, of which they fill more than half; sizes of up to 3e38 and down to 1e-45 come out alike. Scaled by a
/// power of two, so that whoever scales them again rounds as if they had not been: a simplifier gives what it gives to its other users.
[[nodiscard]] inline std::vector<glm::vec3> atUnitSize(const std::vector<glm::vec3>& positions) {
    const Extent extent = extentOf(positions);
    int exponent = 0;
    (void)std::frexp(extent.longest, &exponent);
    const double scale = std::ldexp(1.0, -exponent);
    std::vector<glm::vec3> scaled;
    scaled.reserve(positions.size());
    for (const glm::vec3& p : positions)
        scaled.emplace_back((glm::dvec3(p) - extent.low) * scale);
    return scaled;
}

} // namespace tegument::prep
