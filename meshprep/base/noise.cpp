#include "meshprep/base/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument {

namespace {

/// One of the twelve edge directions of a cube.
float gradientDot(const glm::ivec3& lattice, const glm::vec3& offset, std::uint32_t seed) {
    const std::uint32_t which = hashLattice(lattice, seed).x >> 16;
    const float first = (which & 1u) != 0 ? 1.0f : -1.0f;
    const float second = (which & 2u) != 0 ? 1.0f : -1.0f;
    switch ((which >> 2) % 3) {
    case 0: return first * offset.x + second * offset.y;
    case 1: return first * offset.y + second * offset.z;
    default: return first * offset.z + second * offset.x;
    }
}

float fade(float t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

} // namespace

glm::uvec3 hashLattice(const glm::ivec3& point, std::uint32_t seed) {
    glm::uvec3 v = glm::uvec3(point) + glm::uvec3(seed, seed * 0x9e3779b9u, seed ^ 0x85ebca6bu);
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

glm::vec3 unitRandom(const glm::ivec3& point, std::uint32_t seed) {
    const glm::uvec3 hash = hashLattice(point, seed);
    return glm::vec3(hash >> 8u) * (1.0f / 16777216.0f); // 24 bits: exact in a float
}

float gradientNoise(const glm::vec3& p, std::uint32_t seed) {
    const glm::vec3 cell = glm::floor(p);
    const glm::vec3 t = p - cell;
    const glm::ivec3 base(cell);
    std::array<float, 8> corner{};
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 step(i & 1, (i >> 1) & 1, i >> 2);
        corner[static_cast<std::size_t>(i)] = gradientDot(base + step, t - glm::vec3(step), seed);
    }
    const float u = fade(t.x);
    const float v = fade(t.y);
    const float near = glm::mix(glm::mix(corner[0], corner[1], u), glm::mix(corner[2], corner[3], u), v);
    const float far = glm::mix(glm::mix(corner[4], corner[5], u), glm::mix(corner[6], corner[7], u), v);
    return glm::mix(near, far, fade(t.z));
}

float fractalNoise(const glm::vec3& p, int octaves, std::uint32_t seed) {
    float sum = 0;
    float scale = 1;
    for (int i = 0; i < octaves; ++i) {
        sum += gradientNoise(p * scale, seed + static_cast<std::uint32_t>(i)) / scale;
        scale *= 2;
    }
    return sum;
}

CellDistances cellNoise(const glm::vec3& p, std::uint32_t seed) {
    const glm::vec3 cell = glm::floor(p);
    const glm::ivec3 base(cell);
    float nearest = 16;
    float second = 16;
    for (int i = 0; i < 27; ++i) {
        const glm::ivec3 step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        const glm::vec3 offset = glm::vec3(step) + unitRandom(base + step, seed) - (p - cell);
        const float squared = glm::dot(offset, offset);
        second = std::min(second, std::max(nearest, squared));
        nearest = std::min(nearest, squared);
    }
    return {.nearest = std::sqrt(nearest), .second = std::sqrt(second)};
}

} // namespace tegument
