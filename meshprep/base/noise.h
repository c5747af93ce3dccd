#pragma once
// Deterministic noise in three dimensions, so that spots and pores run across chart borders without a seam.

#include <glm/glm.hpp>

#include <cstdint>

namespace tegument {

/// Three well mixed words for a lattice point (M. Jarzynski and M. Olano, Hash Functions for GPU Rendering, JCGT 9(3), 2020: pcg3d).
[[nodiscard]] glm::uvec3 hashLattice(const glm::ivec3& point, std::uint32_t seed);

/// Each in [0, 1).
[[nodiscard]] glm::vec3 unitRandom(const glm::ivec3& point, std::uint32_t seed);

/// Gradient noise (K. Perlin, Improving Noise, 2002) with hashed gradients; 0 on lattice points, within -1..1, features of size 1.
[[nodiscard]] float gradientNoise(const glm::vec3& p, std::uint32_t seed);

/// Sum of `octaves` gradient noises, each of half the size and half the height of the one before; within -2..2.
[[nodiscard]] float fractalNoise(const glm::vec3& p, int octaves, std::uint32_t seed);

/// Distances to the nearest and second nearest of one random point per lattice cell (S. Worley, A Cellular Texture Basis Function, 1996).
struct CellDistances {
    float nearest = 0;
    float second = 0;
};
[[nodiscard]] CellDistances cellNoise(const glm::vec3& p, std::uint32_t seed);

} // namespace tegument
