#include "host/mesh/glb.h"

#include "host/mesh/extent.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

constexpr double kSteps = 65535;

} // namespace

PositionGrid::PositionGrid(const std::vector<glm::vec3>& positions) {
    const Extent extent = extentOf(positions);
    origin = extent.low;
    step = extent.longest / kSteps;
}

std::array<std::uint16_t, 3> PositionGrid::encode(const glm::vec3& position) const {
    std::array<std::uint16_t, 3> numbers{};
    if (step == 0) return numbers;
    const glm::dvec3 scaled = glm::clamp((glm::dvec3(position) - origin) / step, 0.0, kSteps);
    for (glm::length_t i = 0; i < 3; ++i)
        numbers[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(std::lround(scaled[i]));
    return numbers;
}

std::int16_t toSnorm16(float value) {
    return static_cast<std::int16_t>(std::lround(std::clamp(static_cast<double>(value), -1.0, 1.0) * 32767));
}

} // namespace tegument
