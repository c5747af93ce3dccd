#include "meshprep/human/skin_color.h"

#include "meshprep/base/noise.h"
#include "meshprep/human/eye_color.h"
#include "meshprep/human/pigment.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

// Volume shares added where a region is fully present; judged by eye on the rendered head, within the published ranges (pigment.h).
constexpr float kCheekBlood = 0.0065f;
constexpr float kNoseBlood = 0.0075f;
constexpr float kEarBlood = 0.008f;
constexpr float kChinBlood = 0.003f;
constexpr float kLidBlood = 0.003f;
constexpr float kLidMelanin = 0.003f;
constexpr float kUnderEyeBlood = 0.002f;
constexpr float kForeheadMelanin = 0.003f;
constexpr float kNeckMelanin = 0.003f;
constexpr float kWaterlineBlood = 0.018f;
/// A turn about no axis of the head: noise lies on a lattice, and skin would look woven where it faces along one.
const glm::mat3 kTurn(glm::vec3(0.36f, 0.48f, -0.8f), glm::vec3(-0.8f, 0.6f, 0), glm::vec3(0.48f, 0.64f, 0.6f));
const glm::vec3 kHair(0.045f, 0.027f, 0.017f); // dark brown
const glm::vec3 kLashHair(0.018f, 0.012f, 0.009f);

/// Freckles: one spot per cell of 2.2 mm at most, more of them where the sun reaches first.
float freckles(const glm::vec3& p, const Regions& r, std::uint32_t seed) {
    constexpr float kCell = 2.2f; // mm
    const float density = 0.03f + 0.3f * std::max(r.nose, r.cheeks) + 0.05f * r.forehead - 0.03f * std::max({r.lips, r.lids, r.neck});
    const glm::vec3 cell = glm::floor(p / kCell);
    float spot = 0;
    for (int i = 0; i < 27; ++i) {
        const glm::ivec3 which = glm::ivec3(cell) + glm::ivec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        const glm::vec3 random = unitRandom(which, seed);
        if (random.x > density) continue;
        const glm::vec3 centre = (glm::vec3(which) + unitRandom(which, seed + 1)) * kCell;
        const float radius = glm::mix(0.35f, 1.0f, random.y * random.y);
        spot = std::max(spot, (0.35f + 0.65f * random.z) * (1 - glm::smoothstep(0.35f * radius, radius, glm::distance(p, centre))));
    }
    return spot;
}

Pigments skinPigments(const glm::vec3& p, const Regions& r, std::uint32_t seed) {
    const glm::vec3 q = kTurn * p;
    const float large = fractalNoise(q / 24.0f, 3, seed);      // patches
    const float mottle = fractalNoise(q / 5.0f, 3, seed + 10); // vascular mottling
    const float fine = gradientNoise(q / 1.1f, seed + 20);     // grain
    Pigments pigments;
    pigments.melanin *= 1 + 0.12f * large + 0.10f * fractalNoise(q / 3.0f, 3, seed + 30) + 0.10f * fine;
    pigments.melanin += kLidMelanin * r.lids + kForeheadMelanin * r.forehead + kNeckMelanin * r.neck + 0.002f * r.underEyes;
    pigments.melanin += 0.022f * freckles(p, r, seed + 40);
    const float flush = kCheekBlood * r.cheeks + kNoseBlood * r.nose + kEarBlood * r.ears + kChinBlood * r.chin + kLidBlood * r.lids +
                        kUnderEyeBlood * r.underEyes + kWaterlineBlood * r.waterline;
    pigments.blood = (pigments.blood * (1 + 0.25f * large) + flush) * (1 + 0.38f * mottle + 0.15f * fine);
    pigments.oxygenation -= 0.2f * r.underEyes;
    return pigments;
}

/// Vermilion: little melanin, much blood, in streaks across the lip.
Pigments lipPigments(const glm::vec3& p, std::uint32_t seed) {
    const glm::vec3 q = p + 0.9f * glm::vec3(gradientNoise(p / 2.5f, seed + 51), gradientNoise(p / 2.5f, seed + 52), 0);
    const float streaks = fractalNoise(glm::vec3(q.x / 1.4f, q.y / 3.5f, q.z / 3.5f), 3, seed + 50);
    return {.melanin = 0.019f, .blood = 0.027f * (1 + 0.22f * streaks + 0.3f * fractalNoise(p / 6.0f, 2, seed + 60)), .oxygenation = 0.75f};
}

glm::vec3 skinColor(const SurfacePoint& point, const Face& face, const FacialHair& hairs, std::uint32_t seed) {
    const Regions r = face.regionsAt(point);
    Pigments pigments = skinPigments(point.position, r, seed);
    const Pigments lips = lipPigments(point.position, seed);
    pigments.melanin = glm::mix(pigments.melanin, lips.melanin, r.lips);
    pigments.blood = std::max(0.001f, glm::mix(pigments.blood, lips.blood, r.lips));
    glm::vec3 color = skinReflectance(pigments);
    color *= 1 - 0.62f * r.upperLashes - 0.16f * r.lowerLashes;
    color = glm::mix(color, kLashHair, hairs.lashes.coverage(point.position, point.texelMm) * (1 - r.waterline));
    return glm::mix(color, kHair, 0.9f * hairs.brows.coverage(point.position, point.texelMm));
}

} // namespace

glm::vec4 surfaceColor(const SurfacePoint& point, const Face& face, const FacialHair& hairs, std::uint32_t seed) {
    if (point.part == BustPart::Base) return {skinReflectance({}), 1};
    if (point.part != BustPart::Skin) {
        const float light = face.openingAt(point.position).light(point.position);
        return {eyeColor(point.position, face.eyeAt(point.position), seed) * light, 0};
    }
    return {skinColor(point, face, hairs, seed), 1};
}

} // namespace tegument
