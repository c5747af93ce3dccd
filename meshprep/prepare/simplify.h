#pragma once
// meshoptimizer's simplification: quadric errors after M. Garland, P. Heckbert, Surface simplification using quadric error metrics,
// SIGGRAPH 1997.

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

namespace tegument::prep {

/// Weights of an error of normals against one of places in the unit box; an error of texture coordinates weighs twice that. First the one
/// that comes nearest most often: half is what the library's documentation recommends, and best for scans; without normals machines come
/// out better. Which of the others wins is chance, so the more are tried the better.
inline constexpr std::array kNormalWeights = {0.5f, 0.0f, 0.1f, 0.25f, 0.05f, 0.02f, 0.15f, 0.07f, 0.35f, 0.01f, 0.2f, 0.7f, 1.0f};

/// Normal and texture coordinates.
using SimplifiedAttributes = std::array<float, 5>;

struct Simplification {
    std::span<const std::uint32_t> from;                           // corners of triangles
    std::span<const glm::vec3> positions;                          // of unit size
    std::span<const SimplifiedAttributes> attributes{};            // of each position
    std::size_t counted = std::tuple_size_v<SimplifiedAttributes>; // of each's numbers: the first so many
    std::size_t triangles = 0;                                     // that are wanted; there may be more
    bool keepBorders = false;
    std::set<std::uint32_t> locked{}; // vertices that stay
};

[[nodiscard]] std::vector<std::uint32_t> simplify(const Simplification& what, float normals = kNormalWeights[0]);

} // namespace tegument::prep
