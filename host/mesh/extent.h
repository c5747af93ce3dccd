#pragma once
// The box around positions, in double precision: the difference of two 32-bit floats need not be one.

#include <glm/glm.hpp>

#include <algorithm>
#include <vector>

namespace tegument {

struct Extent {
    glm::dvec3 low{0};
    double longest = 0; // side of the box
};

[[nodiscard]] inline Extent extentOf(const std::vector<glm::vec3>& positions) {
    if (positions.empty()) return {};
    glm::dvec3 low(positions.front());
    glm::dvec3 high = low;
    for (const glm::vec3& p : positions) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    const glm::dvec3 size = high - low;
    return {low, std::max({size.x, size.y, size.z})};
}

} // namespace tegument
