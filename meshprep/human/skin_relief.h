#pragma once
// The fine relief of skin as a height in millimetres over the subdivided surface, evaluated in space: no seams between charts.
// How skin shines by place: how rough its surface is, and how much it mirrors.

#include "meshprep/human/face.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace tegument {

/// Height in mm. `regions` are those of the texel's centre; details smaller than two texels are faded out.
[[nodiscard]] float skinRelief(const glm::vec3& position, const Regions& regions, const Eyeball& eye, float texelMm, std::uint32_t seed);

/// The tangent space normal (x tangent, y bitangent, z normal) of the relief: central differences over one texel, slopes true to scale.
[[nodiscard]] glm::vec3 reliefNormal(const SurfacePoint& point, const Face& face, std::uint32_t seed);

/// Factors of the effect's roughness (Beckmann m) and specular intensity (rho_s), 0 to 1.99.
struct Shine {
    float roughness = 1;
    float intensity = 1;
};
[[nodiscard]] Shine shineAt(const SurfacePoint& point, const Face& face, std::uint32_t seed);

/// Both as the map stores them: 128 of 255 is 1. Red roughness, green intensity.
[[nodiscard]] Image bakeShine(const HeadSurface& head, int size, const Face& face, std::uint32_t seed);

} // namespace tegument
