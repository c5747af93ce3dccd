#pragma once
// The eyeball's colours.

#include "meshprep/human/bust.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace tegument {

/// Linear Rec. 709 reflectance: white with vessels, iris with fibres, limbal ring, pupil, around the axis of sight +z. Without the lids'
/// shadow.
[[nodiscard]] glm::vec3 eyeColor(const glm::vec3& position, const Eyeball& eye, std::uint32_t seed);

} // namespace tegument
