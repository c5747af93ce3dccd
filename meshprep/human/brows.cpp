#include "meshprep/human/brows.h"

#include "meshprep/base/noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tegument {

namespace {

constexpr int kHairs = 420;        // on each side; real brows have 250 to 500
constexpr float kHairWidth = 0.2f; // mm, two hairs side by side: single ones of 0.06 mm would vanish in a texel

/// The brow's middle line, from the nose (0) to the temple (1), in mm from the eye's centre; x grows away from the nose.
glm::vec2 browLine(float t) {
    const float x = glm::mix(-16.0f, 29.0f, t);
    const float rise = 17 + 5 * glm::smoothstep(-0.2f, 0.66f, t) - 5.5f * glm::smoothstep(0.55f, 1.15f, t);
    return {x, rise};
}

/// Half the brow's height: full at the nose, pointed at the temple.
float browHalfHeight(float t) {
    return 4.6f * glm::smoothstep(-0.12f, 0.15f, t) * (1 - 0.78f * t);
}

constexpr float kFull = 0.8f;  // mm from the nearest hair: half the widest gap among them
constexpr float kFaded = 3.0f; // mm

float distanceToSegment(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b) {
    const glm::vec2 along = b - a;
    const float t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0f, 1.0f);
    return glm::distance(p, a + along * t);
}

} // namespace

Brows::Brows(const std::array<Eyeball, 2>& eyes, std::uint32_t seed)
    : brows_{grow(eyes[0], 1, seed), grow(eyes[1], -1, seed + 1)}, front_(eyes[0].centre.z - 25) {}

Brows::Brow Brows::grow(const Eyeball& eye, float side, std::uint32_t seed) {
    Brow brow{.low = glm::vec2(std::numeric_limits<float>::max()), .high = glm::vec2(std::numeric_limits<float>::lowest()), .hairs = {}};
    const glm::vec2 centre(eye.centre.x, eye.centre.y);
    const glm::vec2 mirror(side, 1);
    for (int i = 0; i < kHairs; ++i) {
        const glm::vec3 random = unitRandom(glm::ivec3(i, 0, 0), seed);
        const glm::vec3 more = unitRandom(glm::ivec3(i, 1, 0), seed);
        const float t = random.x;
        const float across = (random.y + more.x - 1); // denser in the middle
        const glm::vec2 root = browLine(t) + glm::vec2(0, across * browHalfHeight(t));
        // Upwards at the nose, then along the brow; hairs above the middle line lean down, those below lean up.
        const float lean = glm::mix(1.25f, 0.12f, glm::smoothstep(0.0f, 0.3f, t)) - 0.5f * across - 0.35f * t + 0.5f * (random.z - 0.5f);
        const float length = glm::mix(5.0f, 7.5f, more.y) * (1 - 0.35f * t);
        const glm::vec2 direction(std::cos(lean), std::sin(lean));
        const glm::vec2 middle = root + direction * (0.5f * length);
        const glm::vec2 tip = middle + glm::normalize(direction + glm::vec2(0.25f, -0.3f)) * (0.5f * length);
        const Hair hair{.root = centre + mirror * root,
                        .middle = centre + mirror * middle,
                        .tip = centre + mirror * tip,
                        .width = kHairWidth * glm::mix(0.6f, 1.2f, more.z)};
        brow.hairs.push_back(hair);
        for (const glm::vec2& p : {hair.root, hair.middle, hair.tip}) {
            brow.low = glm::min(brow.low, p - 1.0f);
            brow.high = glm::max(brow.high, p + 1.0f);
        }
    }
    return brow;
}

float Brows::distanceTo(const Hair& hair, const glm::vec2& p) {
    return std::min(distanceToSegment(p, hair.root, hair.middle), distanceToSegment(p, hair.middle, hair.tip));
}

float Brows::coverage(const glm::vec3& position, float texelMm) const {
    const Brow& brow = brows_[position.x >= 0 ? 0 : 1];
    const glm::vec2 p(position);
    if (position.z < front_ || glm::any(glm::lessThan(p, brow.low)) || glm::any(glm::greaterThan(p, brow.high))) return 0;
    float bare = 1;
    for (const Hair& hair : brow.hairs) {
        const float distance = distanceTo(hair, p);
        const float toTip = std::clamp(glm::distance(p, hair.root) / glm::distance(hair.tip, hair.root), 0.0f, 1.0f);
        const float half = hair.width * (1 - 0.7f * toTip) / 2;
        const float covered = std::min(distance + texelMm / 2, half) - std::max(distance - texelMm / 2, -half);
        bare *= 1 - std::clamp(covered / texelMm, 0.0f, 1.0f);
    }
    return 1 - bare;
}

float Brows::presence(const glm::vec3& position) const {
    const Brow& brow = brows_[position.x >= 0 ? 0 : 1];
    const glm::vec2 p(position);
    const bool away = glm::any(glm::lessThan(p, brow.low - kFaded)) || glm::any(glm::greaterThan(p, brow.high + kFaded));
    if (position.z < front_ || away) return 0;
    float nearest = kFaded;
    for (const Hair& hair : brow.hairs)
        nearest = std::min(nearest, distanceTo(hair, p));
    return 1 - glm::smoothstep(kFull, kFaded, nearest);
}

} // namespace tegument
