#pragma once
// Hairs painted as strokes in a plane: brows from the front, lashes in the chart of the eyeball.

#include <glm/glm.hpp>

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

} // namespace tegument
