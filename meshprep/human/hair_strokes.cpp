#include "meshprep/human/hair_strokes.h"

#include <algorithm>

namespace tegument {

namespace {

float distanceToSegment(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b) {
    const glm::vec2 along = b - a;
    const float t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0f, 1.0f);
    return glm::distance(p, a + along * t);
}

float distanceTo(const HairStroke& hair, const glm::vec2& p) {
    return std::min(distanceToSegment(p, hair.root, hair.middle), distanceToSegment(p, hair.middle, hair.tip));
}

} // namespace

void HairStrokes::add(const HairStroke& hair) {
    hairs_.push_back(hair);
    for (const glm::vec2& p : {hair.root, hair.middle, hair.tip}) {
        low_ = glm::min(low_, p);
        high_ = glm::max(high_, p);
    }
}

bool HairStrokes::outside(const glm::vec2& p, float reach) const {
    return glm::any(glm::lessThan(p, low_ - reach)) || glm::any(glm::greaterThan(p, high_ + reach));
}

float HairStrokes::coverage(const glm::vec2& p, float texelMm) const {
    constexpr float kWidest = 1; // mm, hair and texel
    if (outside(p, kWidest)) return 0;
    float bare = 1;
    for (const HairStroke& hair : hairs_) {
        const float distance = distanceTo(hair, p);
        if (distance > hair.width + texelMm) continue;
        const float toTip = std::clamp(glm::distance(p, hair.root) / glm::distance(hair.tip, hair.root), 0.0f, 1.0f);
        const float half = hair.width * (1 - 0.7f * toTip) / 2;
        const float covered = std::min(distance + texelMm / 2, half) - std::max(distance - texelMm / 2, -half);
        bare *= 1 - hair.opacity * std::clamp(covered / texelMm, 0.0f, 1.0f);
    }
    return 1 - bare;
}

float HairStrokes::distance(const glm::vec2& p, float most) const {
    if (outside(p, most)) return most;
    float nearest = most;
    for (const HairStroke& hair : hairs_)
        nearest = std::min(nearest, distanceTo(hair, p));
    return nearest;
}

} // namespace tegument
