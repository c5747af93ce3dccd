#pragma once
// A surface divided into pieces of about equal size, on which one counts how evenly something lies.

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tegument::prep {

inline constexpr int kPatches = 300;

struct Patches {
    std::vector<std::uint32_t> ofTriangle;
    std::vector<double> area; // kPatches of them; 0 where there are fewer triangles
};

/// Farthest points among the middles of the triangles, one after the other from the first on, each with the triangles nearest to it.
[[nodiscard]] Patches divideIntoPatches(std::span<const std::array<glm::dvec3, 3>> triangles, std::span<const double> area);

/// Standard deviation over mean, both weighted; 0 where the mean is.
[[nodiscard]] double variation(std::span<const double> values, std::span<const double> weights);

} // namespace tegument::prep
