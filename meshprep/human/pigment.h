#pragma once
// Skin colour from what colours skin: melanin in the epidermis, haemoglobin in the dermis (docs/design/human.md gives the formulas and
// sources).

#include <glm/glm.hpp>

namespace tegument {

struct Pigments {
    float melanin = 0.02f;     // volume share of melanosomes in the epidermis: 0.013 to 0.063 for light skin (Jacques 1998)
    float blood = 0.006f;      // volume share of blood in the dermis: 0.002 to 0.07
    float oxygenation = 0.75f; // share of oxygenated haemoglobin
};

/// Diffuse reflectance of the two layers at 610, 550 and 460 nm, the tabulated wavelengths next to the dominant ones of Rec. 709's
/// primaries (611, 549, 464 nm): linear red, green, blue.
[[nodiscard]] glm::vec3 skinReflectance(const Pigments& pigments);

} // namespace tegument
