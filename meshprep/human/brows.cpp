#include "meshprep/human/brows.h"

#include "meshprep/base/noise.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

constexpr int kHairs = 640;         // on each side; two thirds of them grow; real brows have 250 to 500
constexpr float kHairWidth = 0.17f; // mm, two hairs side by side: single ones of 0.06 mm would vanish in a texel

/// The brow's middle line, from the nose (0) to the temple (1), in mm from the eye's centre; x grows away from the nose.
glm::vec2 browLine(float t) {
    const float x = glm::mix(-15.5f, 23.5f, t);
    const float rise = 16 + 5 * glm::smoothstep(-0.2f, 0.7f, t) - 3.6f * glm::smoothstep(0.62f, 1.1f, t);
    return {x, rise};
}

/// Half the brow's height: full at the nose, lower at the temple, where hairs get fewer instead of lining up.
float browHalfHeight(float t) {
    return 4.4f * glm::smoothstep(-0.15f, 0.18f, t) * (1 - 0.6f * t);
}

/// So many of the hairs stand there: both ends run out.
float browDensity(float t) {
    return glm::smoothstep(-0.05f, 0.22f, t) * (1 - 0.85f * glm::smoothstep(0.6f, 1.0f, t));
}

constexpr float kFull = 0.8f;  // mm from the nearest hair: half the widest gap among them
constexpr float kFaded = 3.0f; // mm

HairStroke browHair(int i, std::uint32_t seed) {
    const glm::vec3 random = unitRandom(glm::ivec3(i, 0, 0), seed);
    const glm::vec3 more = unitRandom(glm::ivec3(i, 1, 0), seed);
    const glm::vec3 last = unitRandom(glm::ivec3(i, 2, 0), seed);
    const float t = random.x;
    const float stray = last.y < 0.1f ? 1.5f : 1;         // some grow outside the others
    const float across = stray * (random.y + more.x - 1); // denser in the middle
    const glm::vec2 root = browLine(t) + glm::vec2(0, across * browHalfHeight(t));
    // Upwards at the nose, then along the brow; hairs above the middle line lean down, those below lean up.
    const float lean = glm::mix(1.3f, 0.25f, glm::smoothstep(0.0f, 0.4f, t)) - 0.45f * across - 0.35f * t + 0.8f * (random.z - 0.5f);
    const float length = glm::mix(3.5f, 7.0f, more.y) * (1 - 0.4f * t);
    const glm::vec2 direction(std::cos(lean), std::sin(lean));
    const glm::vec2 middle = root + direction * (0.5f * length);
    const glm::vec2 tip = middle + glm::normalize(direction + glm::vec2(0.25f, -0.35f)) * (0.5f * length);
    return {.root = root,
            .middle = middle,
            .tip = tip,
            .width = kHairWidth * glm::mix(0.55f, 1.2f, more.z),
            .opacity = glm::mix(0.5f, 1.0f, last.x)};
}

HairStroke mirrored(HairStroke hair, float side, const glm::vec2& centre) {
    for (glm::vec2* p : {&hair.root, &hair.middle, &hair.tip})
        *p = centre + glm::vec2(side, 1) * *p;
    return hair;
}

HairStrokes browOf(const Eyeball& eye, float side, std::uint32_t seed) {
    HairStrokes brow;
    for (int i = 0; i < kHairs; ++i) {
        const float t = unitRandom(glm::ivec3(i, 0, 0), seed).x;
        if (unitRandom(glm::ivec3(i, 3, 0), seed).x > browDensity(t)) continue;
        brow.add(mirrored(browHair(i, seed), side, glm::vec2(eye.centre.x, eye.centre.y)));
    }
    return brow;
}

// ---- Lashes

struct LashRow {
    int hairs = 0;
    float length = 0; // mm on the lid, as far as it shows from the front
    float width = 0;  // mm at the root; some lie side by side
    float opacity = 0;
    float up = 0; // 1 above the eye
};
constexpr LashRow kUpperLashes = {.hairs = 150, .length = 3.6f, .width = 0.26f, .opacity = 1, .up = 1};
constexpr LashRow kLowerLashes = {.hairs = 64, .length = 2.0f, .width = 0.15f, .opacity = 0.6f, .up = -1};
constexpr float kLashRoots = 0.45f; // mm from the eyeball: the lid's outer edge

/// The point at `share` of a line's length, and its direction.
glm::vec2 along(const std::vector<glm::vec2>& line, float share) {
    const float place = share * static_cast<float>(line.size() - 1);
    const auto first = std::min(line.size() - 2, static_cast<std::size_t>(place));
    return glm::mix(line[first], line[first + 1], place - static_cast<float>(first));
}

void growLashes(const std::vector<glm::vec2>& line, const LashRow& row, float side, std::uint32_t seed, HairStrokes& lashes) {
    for (int i = 0; i < row.hairs; ++i) {
        const glm::vec3 random = unitRandom(glm::ivec3(i, 4, 0), seed);
        const glm::vec3 more = unitRandom(glm::ivec3(i, 5, 0), seed);
        const float share = glm::mix(0.06f, 0.97f, (static_cast<float>(i) + random.x) / static_cast<float>(row.hairs));
        const glm::vec2 root = along(line, share) + glm::vec2(0, row.up * kLashRoots * (0.75f + 0.4f * more.y));
        const float outwards = side * (2 * share - 1); // away from the nose, as x grows away from it on the left only
        const float towardsTemple = side > 0 ? share : 1 - share;
        const float length =
            row.length * glm::mix(0.4f, 1.0f, random.y) * glm::mix(0.35f, 1.1f, glm::smoothstep(0.0f, 0.6f, towardsTemple));
        const glm::vec2 way = glm::normalize(glm::vec2(side * (0.9f * outwards + 0.25f) + 0.5f * (random.z - 0.5f), row.up));
        const glm::vec2 middle = root + way * (0.55f * length);
        const glm::vec2 tip = middle + glm::normalize(way + glm::vec2(0.2f * side, 0.25f * row.up)) * (0.45f * length);
        lashes.add({.root = root,
                    .middle = middle,
                    .tip = tip,
                    .width = row.width * glm::mix(0.7f, 1.1f, more.z),
                    .opacity = row.opacity * glm::mix(0.6f, 1.0f, more.x)});
    }
}

float distanceToSegment(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b) {
    const glm::vec2 along = b - a;
    const float t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0f, 1.0f);
    return glm::distance(p, a + along * t);
}

float distanceTo(const HairStroke& hair, const glm::vec2& p) {
    return std::min(distanceToSegment(p, hair.root, hair.middle), distanceToSegment(p, hair.middle, hair.tip));
}

} // namespace

Brows::Brows(const std::array<Eyeball, 2>& eyes, std::uint32_t seed)
    : brows_{browOf(eyes[0], 1, seed), browOf(eyes[1], -1, seed + 1)}, front_(eyes[0].centre.z - 25) {}

float Brows::coverage(const glm::vec3& position, float texelMm) const {
    return position.z < front_ ? 0 : brows_[position.x >= 0 ? 0 : 1].coverage(glm::vec2(position), texelMm);
}

float Brows::presence(const glm::vec3& position) const {
    if (position.z < front_) return 0;
    return 1 - glm::smoothstep(kFull, kFaded, brows_[position.x >= 0 ? 0 : 1].distance(glm::vec2(position), kFaded));
}

Lashes::Lashes(const std::array<Eyeball, 2>& eyes, const std::array<EyeOpening, 2>& openings, std::uint32_t seed) : eyes_(eyes) {
    for (std::size_t e = 0; e < 2; ++e) {
        if (openings[e].empty()) continue;
        const float side = e == 0 ? 1.0f : -1.0f;
        const auto own = seed + 100 + static_cast<std::uint32_t>(e);
        growLashes(openings[e].upper(), kUpperLashes, side, own, lashes_[e]);
        growLashes(openings[e].lower(), kLowerLashes, side, own + 10, lashes_[e]);
    }
}

float Lashes::coverage(const glm::vec3& position, float texelMm) const {
    constexpr float kThickest = 6; // mm of lid before the eyeball
    const std::size_t e = position.x >= 0 ? 0 : 1;
    const glm::vec3 from = position - eyes_[e].centre;
    if (from.z <= 0 || glm::length(from) > eyes_[e].radius + kThickest) return 0;
    return lashes_[e].coverage(eyeChart(eyes_[e], position), texelMm);
}

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
