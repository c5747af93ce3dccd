#pragma once

#include <glm/glm.hpp>

namespace tegument {

/// Points that fill a cube of 40 mm evenly enough (multiples of the golden ratio and its kin).
inline glm::vec3 spread(int i) {
    const auto t = static_cast<float>(i);
    return 40.0f * glm::fract(glm::vec3(0.8191725f, 0.6710436f, 0.5497005f) * t) - 20.0f;
}

} // namespace tegument
