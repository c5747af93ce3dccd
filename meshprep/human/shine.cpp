// By region after T. Weyrich et al., Analysis of Human Faces using a Measurement-Based Skin Reflectance Model, 2006, who fitted rho_s and m
// of ten regions of the face: they differ, as sebum and moisture do. The factors are ours, by eye: their table was not at hand.

#include "meshprep/human/shine.h"

#include "meshprep/base/noise.h"

#include <algorithm>

namespace tegument {

namespace {

constexpr Shine kForeheadShine = {.roughness = 0.92f, .intensity = 1.1f};
constexpr Shine kTZone = {.roughness = 0.82f, .intensity = 1.3f}; // sebum
constexpr Shine kNoseShine = {.roughness = 0.78f, .intensity = 1.35f};
constexpr Shine kChin = {.roughness = 0.92f, .intensity = 1.1f};
constexpr Shine kCheekShine = {.roughness = 1.04f, .intensity = 0.95f};
constexpr Shine kLidShine = {.roughness = 0.88f, .intensity = 1.05f};
constexpr Shine kEarShine = {.roughness = 1.1f, .intensity = 0.8f};
constexpr Shine kNeck = {.roughness = 1.15f, .intensity = 0.75f};
constexpr Shine kLipShine = {.roughness = 0.62f, .intensity = 1.35f}; // moist
constexpr Shine kWaterline = {.roughness = 0.3f, .intensity = 1.98f}; // wet
constexpr float kNeutral = 128;
constexpr float kSteps = 255;

Shine mix(const Shine& a, const Shine& b, float share) {
    return {.roughness = glm::mix(a.roughness, b.roughness, share), .intensity = glm::mix(a.intensity, b.intensity, share)};
}

} // namespace

Shine shineAt(const SurfacePoint& point, const Face& face, std::uint32_t seed) {
    if (point.part != BustPart::Skin) return {};
    const Regions r = face.regionsAt(point);
    Shine shine;
    shine = mix(shine, kNeck, r.neck);
    shine = mix(shine, kForeheadShine, r.forehead);
    shine = mix(shine, kCheekShine, r.cheeks);
    shine = mix(shine, kChin, r.chin);
    shine = mix(shine, kTZone, std::min(1.0f, r.tZone));
    shine = mix(shine, kNoseShine, r.nose);
    shine = mix(shine, kEarShine, r.ears);
    shine = mix(shine, kLidShine, r.lids);
    shine.intensity *= 1 + 0.15f * fractalNoise(point.position / 7.0f, 3, seed + 500); // sebum is no even film
    shine = mix(shine, kLipShine, r.lips);
    return mix(shine, kWaterline, r.waterline);
}

Image bakeShine(const HeadSurface& head, int size, const Face& face, std::uint32_t seed) {
    return bakeTexture(head, size, 3, [&](const SurfacePoint& point) {
        const Shine shine = shineAt(point, face, seed);
        return glm::min(glm::vec4(shine.roughness, shine.intensity, 0, 0) * (kNeutral / kSteps), 1.0f);
    });
}

} // namespace tegument
