#pragma once
// Eyebrows and lashes painted hair by hair.
// Hairs painted as strokes in a plane: brows from the front, lashes in the chart of the eyeball.

#include "meshprep/human/bust.h"
#include "meshprep/human/eye_opening.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace tegument {

/// A bent hair, mm.
struct HairStroke {
    glm::vec2 root{0};
    glm::vec2 middle{0};
    glm::vec2 tip{0};
    float width = 0;
    float opacity = 1; // light hairs cover less
};

class HairStrokes {
public:
    void add(const HairStroke& hair);

    /// How much hair covers of a texel, 0 to 1; hairs thinner than it cover it in part.
    [[nodiscard]] float coverage(const glm::vec2& p, float texelMm) const;
    /// mm to the nearest hair, `most` where it is farther.
    [[nodiscard]] float distance(const glm::vec2& p, float most) const;

private:
    [[nodiscard]] bool outside(const glm::vec2& p, float reach) const;

    std::vector<HairStroke> hairs_;
    glm::vec2 low_{std::numeric_limits<float>::max()};
    glm::vec2 high_{std::numeric_limits<float>::lowest()};
};

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
