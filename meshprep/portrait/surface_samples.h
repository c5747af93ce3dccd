#pragma once
// Points spread evenly over a surface, whatever its triangles, in an order that follows the file's.

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace tegument {

struct SurfaceSample {
    glm::dvec3 point{0};
    glm::dvec3 normal{0}; // unit, of the triangle
    std::uint32_t triangle = 0;
    glm::dvec3 corners{0}; // weights of the triangle's corners
};

/// About `count` of them; none where no triangle has an area.
[[nodiscard]] std::vector<SurfaceSample> sampleSurface(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                                       int count = 40'000);

} // namespace tegument
