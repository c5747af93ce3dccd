#pragma once
// The point of a triangle that is nearest to a point.

#include <glm/glm.hpp>

namespace tegument::prep {

[[nodiscard]] glm::dvec3 nearestOnTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

} // namespace tegument::prep
