#pragma once
// Eyebrows and lashes painted hair by hair.

#include "meshprep/human/bust.h"
#include "meshprep/human/eye_opening.h"
#include "meshprep/human/hair_strokes.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace tegument {

class Brows {
public:
    Brows(const std::array<Eyeball, 2>& eyes, std::uint32_t seed);

    /// How much of the skin at this point hair covers, 0 to 1; hairs thinner than a texel cover it in part.
    [[nodiscard]] float coverage(const glm::vec3& position, float texelMm) const;

    /// How much this point belongs to a brow: 1 among its hairs, 0 from 3 mm outside them.
    [[nodiscard]] float presence(const glm::vec3& position) const;

private:
    std::array<HairStrokes, 2> brows_; // left, right; from the front
    float front_ = 0;                  // z in front of which the brows lie
};

/// Lashes as they are seen from the front: on the lids, from their rims outwards.
class Lashes {
public:
    Lashes(const std::array<Eyeball, 2>& eyes, const std::array<EyeOpening, 2>& openings, std::uint32_t seed);

    [[nodiscard]] float coverage(const glm::vec3& position, float texelMm) const;

private:
    std::array<Eyeball, 2> eyes_;
    std::array<HairStrokes, 2> lashes_; // in the eyeballs' charts
};

} // namespace tegument
