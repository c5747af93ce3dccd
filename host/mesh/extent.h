#pragma once
// The box around positions, in double precision: the difference of two 32-bit floats need not be one.
// Lengths for messages.

#include <fmt/format.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <string>
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

/// Three digits, or all before the point: 0.0123, 15.5, 1553, 4000000000. Nobody reads 4e+09 mm as four thousand kilometres.
[[nodiscard]] inline std::string lengthText(double mm) {
    constexpr double kDigits = 999.5; // from here on three digits round to four
    constexpr double kExact = 1e15;   // beyond, the digits of a double say nothing
    return std::abs(mm) >= kDigits && std::abs(mm) < kExact ? fmt::format("{:.0f}", mm) : fmt::format("{:.3g}", mm);
}

} // namespace tegument
