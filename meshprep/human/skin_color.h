#pragma once
// The colour map: skin from pigments, and the eyes.

#include "meshprep/human/brows.h"
#include "meshprep/human/face.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace tegument {

/// Linear Rec. 709 reflectance; alpha is the scatter mask: 1 skin, 0 a plain material (eyes).
[[nodiscard]] glm::vec4 surfaceColor(const SurfacePoint& point, const Face& face, const Brows& brows, std::uint32_t seed);

/// Eyeball: white with vessels, iris with fibres, limbal ring, pupil, around the axis of sight +z.
[[nodiscard]] glm::vec3 eyeColor(const glm::vec3& position, const Eyeball& eye, std::uint32_t seed);

} // namespace tegument
