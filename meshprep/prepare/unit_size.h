#pragma once
// For algorithms that work in single precision: their squares and reciprocals neither vanish nor overflow at unit size.

#include <glm/glm.hpp>

#include <algorithm>
#include <vector>

namespace tegument::prep {

/// Positions moved and scaled into the unit box; sizes of up to 3e38 and down to 1e-45 come out alike.
[[nodiscard]] inline std::vector<glm::vec3> atUnitSize(const std::vector<glm::vec3>& positions) {
    if (positions.empty()) return {};
    glm::dvec3 low(positions.front());
    glm::dvec3 high = low;
    for (const glm::vec3& p : positions) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    const glm::dvec3 size = high - low;
    const double scale = std::max({size.x, size.y, size.z});
    std::vector<glm::vec3> scaled;
    scaled.reserve(positions.size());
    for (const glm::vec3& p : positions)
        scaled.push_back(scale > 0 ? glm::vec3((glm::dvec3(p) - low) / scale) : glm::vec3(0));
    return scaled;
}

} // namespace tegument::prep
