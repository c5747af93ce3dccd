#include "meshprep/human/skin_color.h"

#include "meshprep/base/noise.h"
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
const glm::vec3 kHair(0.045f, 0.027f, 0.017f); // dark brown

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
    const float large = fractalNoise(p / 24.0f, 3, seed);      // patches
    const float mottle = fractalNoise(p / 5.0f, 3, seed + 10); // vascular mottling
    const float fine = gradientNoise(p / 1.1f, seed + 20);     // grain
    Pigments pigments;
    pigments.melanin *= 1 + 0.12f * large + 0.10f * fractalNoise(p / 3.0f, 3, seed + 30) + 0.10f * fine;
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
    const float streaks = fractalNoise(glm::vec3(p.x / 1.1f, p.y / 5, p.z / 5), 3, seed + 50);
    return {.melanin = 0.019f, .blood = 0.026f * (1 + 0.4f * streaks + 0.3f * fractalNoise(p / 6.0f, 2, seed + 60)), .oxygenation = 0.75f};
}

glm::vec3 skinColor(const SurfacePoint& point, const Face& face, const Brows& brows, std::uint32_t seed) {
    const Regions r = face.regionsAt(point);
    Pigments pigments = skinPigments(point.position, r, seed);
    const Pigments lips = lipPigments(point.position, seed);
    pigments.melanin = glm::mix(pigments.melanin, lips.melanin, r.lips);
    pigments.blood = std::max(0.001f, glm::mix(pigments.blood, lips.blood, r.lips));
    glm::vec3 color = skinReflectance(pigments);
    color *= 1 - 0.6f * r.upperLashes * (1 - r.waterline) - 0.15f * r.lowerLashes * (1 - r.waterline); // lashes from the front
    return glm::mix(color, kHair, 0.9f * brows.coverage(point.position, point.texelMm));
}

// ---- Eyes

constexpr float kIrisRadius = 6.6f;  // mm along the eyeball; a real iris measures 5.9, the file's eyeballs are larger than real ones
constexpr float kPupilRadius = 2.0f; // mm, indoors

/// 0 in the iris, 1 in the white.
float limbus(float radius) {
    return glm::smoothstep(kIrisRadius - 0.5f, kIrisRadius + 0.35f, radius);
}

glm::vec3 irisColor(float radius, float angle, std::uint32_t seed) {
    const glm::vec2 around(std::cos(angle), std::sin(angle));
    const float share = (radius - kPupilRadius) / (kIrisRadius - kPupilRadius);
    const float fibres = fractalNoise(glm::vec3(around * 9.0f, share * 0.9f), 4, seed);
    const float wave = fractalNoise(glm::vec3(around * 2.5f, 3), 2, seed + 5);
    const glm::vec3 inner(0.12f, 0.078f, 0.04f);  // collarette: hazel
    const glm::vec3 outer(0.075f, 0.085f, 0.08f); // grey-green
    const glm::vec3 base = glm::mix(inner, outer, glm::smoothstep(0.1f, 0.55f, share + 0.25f * wave));
    const float ring = 1 - 0.72f * glm::smoothstep(0.7f, 1.0f, share);            // limbal ring
    const float rim = glm::mix(0.45f, 1.0f, glm::smoothstep(0.0f, 0.12f, share)); // pupil's frill
    return base * std::max(0.25f, 1 + 0.85f * fibres) * ring * rim;
}

glm::vec3 scleraColor(const glm::vec3& fromCentre, float radius, std::uint32_t seed) {
    const glm::vec3 white(0.62f, 0.56f, 0.52f);
    const glm::vec3 flushed(0.50f, 0.27f, 0.23f);
    const glm::vec3 warped =
        fromCentre + 0.7f * glm::vec3(gradientNoise(fromCentre / 1.6f, seed + 7), gradientNoise(fromCentre / 1.6f, seed + 8), 0);
    const float lines = std::abs(gradientNoise(glm::vec3(warped.x / 6, warped.y / 1.7f, warped.z / 6), seed + 9));
    const float vessels = (1 - glm::smoothstep(0.0f, 0.05f, lines)) * (0.5f + 0.5f * gradientNoise(fromCentre / 3.0f, seed + 11));
    const float corner = glm::smoothstep(7.5f, 15.0f, radius);
    return glm::mix(white, flushed, std::clamp(0.5f * corner + 0.4f * vessels * (0.35f + corner), 0.0f, 1.0f));
}

} // namespace

glm::vec3 eyeColor(const glm::vec3& position, const Eyeball& eye, std::uint32_t seed) {
    const glm::vec3 d = position - eye.centre;
    const glm::vec2 plane = eyeChart(eye, position);
    const float radius = glm::length(plane);
    const float pupil = 1 - glm::smoothstep(kPupilRadius - 0.15f, kPupilRadius + 0.15f, radius);
    const glm::vec3 iris = glm::mix(irisColor(radius, std::atan2(plane.y, plane.x), seed), glm::vec3(0.004f), pupil);
    const glm::vec3 color = glm::mix(iris, scleraColor(d, radius, seed), limbus(radius));
    const float lidShadow = glm::smoothstep(2.0f, 6.5f, d.y); // lashes and lid take the sky from the upper part
    return color * (1 - 0.45f * lidShadow);
}

glm::vec4 surfaceColor(const SurfacePoint& point, const Face& face, const Brows& brows, std::uint32_t seed) {
    if (point.part == BustPart::Base) return {skinReflectance({}), 1};
    if (point.part != BustPart::Skin) return {eyeColor(point.position, face.eyeAt(point.position), seed), 0};
    return {skinColor(point, face, brows, seed), 1};
}

} // namespace tegument
