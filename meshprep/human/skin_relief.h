#pragma once
// The fine relief of skin as a height in millimetres over the subdivided surface, evaluated in space: no seams between charts.

#include "meshprep/human/face.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace tegument {

/// Height in mm. `regions` are those of the texel's centre; details smaller than two texels are faded out.
[[nodiscard]] float skinRelief(const glm::vec3& position, const Regions& regions, const Eyeball& eye, float texelMm, std::uint32_t seed);

/// The tangent space normal (x tangent, y bitangent, z normal) of the relief: central differences over one texel, slopes true to scale.
[[nodiscard]] glm::vec3 reliefNormal(const SurfacePoint& point, const Face& face, std::uint32_t seed);

} // namespace tegument
