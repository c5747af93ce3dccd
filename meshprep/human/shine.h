#pragma once
// How skin shines by place: how rough its surface is, and how much it mirrors.

#include "meshprep/human/face.h"

#include <cstdint>

namespace tegument {

/// Factors of the effect's roughness (Beckmann m) and specular intensity (rho_s), 0 to 1.99.
struct Shine {
    float roughness = 1;
    float intensity = 1;
};
[[nodiscard]] Shine shineAt(const SurfacePoint& point, const Face& face, std::uint32_t seed);

/// Both as the map stores them: 128 of 255 is 1. Red roughness, green intensity.
[[nodiscard]] Image bakeShine(const HeadSurface& head, int size, const Face& face, std::uint32_t seed);

} // namespace tegument
