#pragma once
// Eyebrows painted hair by hair.

#include "meshprep/human/bust.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace tegument {

class Brows {
public:
    Brows(const std::array<Eyeball, 2>& eyes, std::uint32_t seed);

    /// How much of the skin at this point hair covers, 0 to 1; hairs thinner than a texel cover it in part.
    [[nodiscard]] float coverage(const glm::vec3& position, float texelMm) const;

    /// How much this point belongs to a brow: 1 among its hairs, 0 from 3 mm outside them.
    [[nodiscard]] float presence(const glm::vec3& position) const;

private:
    /// A bent hair as it is seen from the front, mm.
    struct Hair {
        glm::vec2 root{0};
        glm::vec2 middle{0};
        glm::vec2 tip{0};
        float width = 0;
    };
    struct Brow {
        glm::vec2 low{0};
        glm::vec2 high{0};
        std::vector<Hair> hairs;
    };

    static float distanceTo(const Hair& hair, const glm::vec2& p);
    static Brow grow(const Eyeball& eye, float side, std::uint32_t seed);

    std::array<Brow, 2> brows_; // left, right
    float front_ = 0;           // z in front of which the brows lie
};

} // namespace tegument
