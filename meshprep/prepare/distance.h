#pragma once
// How far one surface is from another.

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace tegument::prep {

struct SurfaceDistance {
    double greatest = 0;
    double rms = 0;
};

/// From the corners and centroids of the triangles `from` to the nearest points of the triangles `to`, both over the same positions.
[[nodiscard]] SurfaceDistance distance(const std::vector<glm::vec3>& positions, std::span<const std::uint32_t> from,
                                       std::span<const std::uint32_t> to);

} // namespace tegument::prep
