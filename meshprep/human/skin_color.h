#pragma once
// The colour map: skin from pigments, and the eyes.
// Skin colour from what colours skin: melanin in the epidermis, haemoglobin in the dermis (docs/design/human.md gives the formulas and
// sources).
// The eyeball's colours.

#include "meshprep/human/brows.h"
#include "meshprep/human/bust.h"
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

struct Pigments {
    float melanin = 0.02f;     // volume share of melanosomes in the epidermis: 0.013 to 0.063 for light skin (Jacques 1998)
    float blood = 0.006f;      // volume share of blood in the dermis: 0.002 to 0.07
    float oxygenation = 0.75f; // share of oxygenated haemoglobin
};

/// Diffuse reflectance of the two layers at 610, 550 and 460 nm, the tabulated wavelengths next to the dominant ones of Rec. 709's
/// primaries (611, 549, 464 nm): linear red, green, blue.
[[nodiscard]] glm::vec3 skinReflectance(const Pigments& pigments);

/// Linear Rec. 709 reflectance: white with vessels, iris with fibres, limbal ring, pupil, around the axis of sight +z. Without the lids'
/// shadow.
[[nodiscard]] glm::vec3 eyeColor(const glm::vec3& position, const Eyeball& eye, std::uint32_t seed);

} // namespace tegument
