#pragma once
// The colour map: skin from pigments, and the eyes.

#include "meshprep/human/brows.h"
#include "meshprep/human/face.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace tegument {

struct FacialHair {
    const Brows& brows;
    const Lashes& lashes;
};

/// Linear Rec. 709 reflectance; alpha is the scatter mask: 1 skin, 0 a plain material (eyes).
[[nodiscard]] glm::vec4 surfaceColor(const SurfacePoint& point, const Face& face, const FacialHair& hairs, std::uint32_t seed);

} // namespace tegument
