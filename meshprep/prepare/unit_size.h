#pragma once
// For algorithms that work in single precision: their squares and reciprocals neither vanish nor overflow at unit size.

#include "host/mesh/extent.h"

namespace tegument::prep {

/// Positions moved and scaled into the unit box; sizes of up to 3e38 and down to 1e-45 come out alike.
[[nodiscard]] inline std::vector<glm::vec3> atUnitSize(const std::vector<glm::vec3>& positions) {
    const Extent extent = extentOf(positions);
    std::vector<glm::vec3> scaled;
    scaled.reserve(positions.size());
    for (const glm::vec3& p : positions)
        scaled.push_back(extent.longest > 0 ? glm::vec3((glm::dvec3(p) - extent.low) / extent.longest) : glm::vec3(0));
    return scaled;
}

} // namespace tegument::prep
