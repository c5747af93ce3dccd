#include "meshprep/human/skin_color.h"

#include "meshprep/base/noise.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

// Volume shares added where a region is fully present; judged by eye on the rendered head, within the published ranges.
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

// Two layers. The epidermis absorbs only: light crosses it twice. The dermis scatters and absorbs without end in depth: diffuse reflectance
// of H. W. Jensen, S. Marschner, M. Levoy, P. Hanrahan, A Practical Model for Subsurface Light Transport, 2001, section 2.4.
//
//   melanosomes      mu_a = 1.70e11 l^-3.48 /mm                      S. L. Jacques, Skin Optics, Oregon Medical Laser Center News, 1998
//   bloodless tissue mu_a = 0.0244 + 8.53 exp(-(l - 154) / 66.2) /mm  the same
//   whole blood      mu_a = 2.303 e 150 g/l / 64500 g/mol            S. Prahl, Tabulated Molar Extinction Coefficient for Hemoglobin in
//                                                                    Water, 1998 (e in 1/(cm mol/l))
//   dermis           mu_s' = 6.87 (l / 500 nm)^-1.161 /mm            S. L. Jacques, Optical properties of biological tissues: a review,
//   2013,
//                                                                    table 1, skin after Simpson et al. 1998
// l is the wavelength in nm.

constexpr glm::vec3 kWavelength(610, 550, 460);      // nm
constexpr glm::vec3 kOxygenated(1506, 43016, 44480); // Prahl, 1/(cm mol/l)
constexpr glm::vec3 kDeoxygenated(9443.6f, 53412, 23388.8f);
constexpr float kBloodPerExtinction = 2.303f * 150 / 64500 / 10; // 1/mm for 1/(cm mol/l)
constexpr float kEpidermis = 0.06f;                              // mm
constexpr float kPath = 4; // diffuse light crosses a thin layer on paths twice its thickness on the mean, once in and once out

/// Internal reflection of diffuse light at a boundary of index 1.4 (Jensen et al. 2001, section 2.1): (1 + F) / (1 - F).
float boundaryTerm() {
    constexpr float kIndex = 1.4f;
    constexpr float kReflected = -1.440f / (kIndex * kIndex) + 0.710f / kIndex + 0.668f + 0.0636f * kIndex;
    return (1 + kReflected) / (1 - kReflected);
}

glm::vec3 dermisReflectance(const glm::vec3& absorption) {
    const glm::vec3 scattering = 6.87f * glm::pow(kWavelength / 500.0f, glm::vec3(-1.161f));
    const glm::vec3 albedo = scattering / (scattering + absorption);
    const glm::vec3 root = glm::sqrt(3.0f * (1.0f - albedo));
    return albedo / 2.0f * (1.0f + glm::exp(-4.0f / 3 * boundaryTerm() * root)) * glm::exp(-root);
}

constexpr float kPupilRadius = 1.7f; // mm, indoors

/// 0 in the iris, 1 in the white: a soft border, as the clear cornea passes into the white over a millimetre.
float limbus(float radius) {
    return glm::smoothstep(kIrisRadius - 0.65f, kIrisRadius + 0.45f, radius);
}

glm::vec3 irisColor(float radius, float angle, std::uint32_t seed) {
    const glm::vec2 around(std::cos(angle), std::sin(angle));
    const float share = (radius - kPupilRadius) / (kIrisRadius - kPupilRadius);
    const float fibres = fractalNoise(glm::vec3(around * 9.0f, share * 0.9f), 4, seed);
    const float wave = fractalNoise(glm::vec3(around * 2.5f, 3), 2, seed + 5);
    const glm::vec3 inner(0.105f, 0.068f, 0.036f); // collarette: hazel
    const glm::vec3 outer(0.058f, 0.066f, 0.062f); // grey-green
    const glm::vec3 base = glm::mix(inner, outer, glm::smoothstep(0.1f, 0.55f, share + 0.25f * wave));
    const float ring = 1 - 0.65f * glm::smoothstep(0.62f, 1.0f, share);              // limbal ring
    const float rim = glm::mix(0.45f, 1.0f, glm::smoothstep(0.0f, 0.12f, share));    // pupil's frill
    const float gathered = 1 - 0.3f * around.y * glm::smoothstep(0.1f, 0.8f, share); // the cornea gathers light from above below
    return base * std::max(0.25f, 1 + 0.85f * fibres) * ring * rim * gathered;
}

glm::vec3 scleraColor(const glm::vec3& fromCentre, float radius, std::uint32_t seed) {
    const glm::vec3 white(0.5f, 0.445f, 0.41f); // a living one is no paper: .7 to .75 of it in sRGB
    const glm::vec3 flushed(0.43f, 0.23f, 0.2f);
    const glm::vec3 warped =
        fromCentre + 0.7f * glm::vec3(gradientNoise(fromCentre / 1.6f, seed + 7), gradientNoise(fromCentre / 1.6f, seed + 8), 0);
    const float lines = std::abs(gradientNoise(glm::vec3(warped.x / 6, warped.y / 1.7f, warped.z / 6), seed + 9));
    const float vessels = (1 - glm::smoothstep(0.0f, 0.05f, lines)) * (0.5f + 0.5f * gradientNoise(fromCentre / 3.0f, seed + 11));
    const float corner = glm::smoothstep(7.5f, 13.5f, radius);
    const float blotch = 0.12f * fractalNoise(fromCentre / 4.0f, 3, seed + 12);
    const glm::vec3 clear =
        white * glm::mix(glm::vec3(0.86f, 0.92f, 1.0f), glm::vec3(1), glm::smoothstep(5.5f, 8.0f, radius)); // bluish at the iris
    return glm::mix(clear, flushed, std::clamp(0.08f + blotch + 0.55f * corner + 0.4f * vessels * (0.35f + corner), 0.0f, 1.0f));
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

glm::vec3 skinReflectance(const Pigments& pigments) {
    const glm::vec3 melanosomes = 1.70e11f * glm::pow(kWavelength, glm::vec3(-3.48f));
    const glm::vec3 tissue = 0.0244f + 8.53f * glm::exp((154.0f - kWavelength) / 66.2f);
    const glm::vec3 blood = kBloodPerExtinction * glm::mix(kDeoxygenated, kOxygenated, pigments.oxygenation);
    const glm::vec3 epidermis = glm::mix(tissue, melanosomes, pigments.melanin);
    const glm::vec3 dermis = glm::mix(tissue, blood, pigments.blood);
    return glm::exp(-kPath * kEpidermis * epidermis) * dermisReflectance(dermis);
}

glm::vec3 eyeColor(const glm::vec3& position, const Eyeball& eye, std::uint32_t seed) {
    const glm::vec2 plane = eyeChart(eye, position);
    const float radius = glm::length(plane);
    const float pupil = 1 - glm::smoothstep(kPupilRadius - 0.15f, kPupilRadius + 0.15f, radius);
    const glm::vec3 iris = glm::mix(irisColor(radius, std::atan2(plane.y, plane.x), seed), glm::vec3(0.004f), pupil);
    return glm::mix(iris, scleraColor(position - eye.centre, radius, seed), limbus(radius));
}

} // namespace tegument
