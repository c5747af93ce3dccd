// Amplitudes and spacings are chosen by eye within what profilometry reports for facial skin: furrows 0.02 to 0.1 mm deep and 0.3 to 1 mm
// apart, pores 0.05 to 0.5 mm wide, arithmetic mean roughness of 5 to 40 micrometres (docs/design/human.md).

#include "meshprep/human/skin_relief.h"

#include "meshprep/base/noise.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

/// 1 for details that the texels can hold, 0 for those that would alias.
float resolved(float sizeMm, float texelMm) {
    return glm::smoothstep(1.0f, 2.5f, sizeMm / texelMm);
}

/// Round pits: at most one in each cell of `spacing`; radius at most a quarter of it, so eight cells are enough.
float pits(const glm::vec3& p, float spacing, float radius, float share, std::uint32_t seed) {
    const glm::vec3 q = p / spacing - 0.5f;
    const glm::ivec3 base(glm::floor(q));
    float depth = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 cell = base + glm::ivec3(i & 1, (i >> 1) & 1, i >> 2);
        const glm::vec3 random = unitRandom(cell, seed);
        if (random.x > share) continue;
        const glm::vec3 centre = glm::vec3(cell) + 0.25f + 0.5f * unitRandom(cell, seed + 1);
        const float wide = radius / spacing * glm::mix(0.7f, 1.0f, random.y);
        const float t = glm::distance(p / spacing, centre) / wide;
        if (t < 1) depth = std::max(depth, (1 - t * t) * (1 - t * t) * glm::mix(0.55f, 1.0f, random.z));
    }
    return depth;
}

/// A pit shows where the surface passes through it, which it seldom does: two sets of them are a face's.
float twicePits(const glm::vec3& p, float spacing, float radius, float share, std::uint32_t seed) {
    return std::max(pits(p, spacing, radius, share, seed), pits(p + 0.5f * spacing, spacing, radius, share, seed + 700));
}

/// The net of furrows between polygons of skin: borders of Voronoi cells, 1 in the middle of a furrow.
float furrows(const glm::vec3& q, float width, std::uint32_t seed) {
    const CellDistances cells = cellNoise(q, seed);
    const float t = std::min(1.0f, (cells.second - cells.nearest) / width);
    return (1 - t) * (1 - t) * (1 + 2 * t);
}

/// From 0 to 1 and back over `size` mm, so that no pattern is everywhere alike.
float patches(const glm::vec3& p, float size, std::uint32_t seed) {
    return glm::smoothstep(-0.35f, 0.45f, gradientNoise(p / size + 0.37f, seed));
}

/// The same on both sides of the face, turned about z: x along lines that fall outwards over the cheeks, as the skin's tension has them.
glm::vec3 alongCheek(const glm::vec3& p) {
    constexpr float kFall = 0.87f; // rad under the horizon
    const float x = std::abs(p.x);
    const float c = std::cos(kFall);
    const float s = std::sin(kFall);
    return {c * x - s * p.y, s * x + c * p.y, p.z};
}

/// Furrows in mm: cells drawn out across the face on the forehead, down the cheeks, hardly on the nose; finer and fainter elsewhere.
float skinNet(const glm::vec3& p, const Regions& r, float texelMm, std::uint32_t seed) {
    const float warp = 0.3f;
    const glm::vec3 q =
        p + warp * glm::vec3(gradientNoise(p / 1.7f, seed + 3), gradientNoise(p / 1.7f, seed + 4), gradientNoise(p / 1.7f, seed + 5));
    const float cheek = std::min(1.0f, r.cheeks + 0.5f * r.underEyes);
    const float rest = std::max(0.0f, 1 - r.forehead - cheek - r.nose);
    const std::uint32_t side = p.x < 0 ? 50 : 0;
    float depth = 0;
    if (r.forehead > 0.02f) depth += 0.024f * r.forehead * furrows(q / glm::vec3(2.1f, 0.85f, 2.1f), 0.4f, seed + 20);
    if (cheek > 0.02f) depth += 0.028f * cheek * furrows(alongCheek(q) / glm::vec3(1.7f, 0.8f, 1.3f), 0.4f, seed + 21 + side);
    if (rest > 0.02f) depth += 0.017f * rest * furrows(q / glm::vec3(1.3f, 0.75f, 1.3f), 0.4f, seed + 22);
    depth *= resolved(0.5f, texelMm);
    depth += 0.013f * furrows(q / 0.55f, 0.4f, seed + 30) * resolved(0.3f, texelMm);
    return depth * glm::mix(0.35f, 1.0f, patches(p, 6, seed + 31)) * (1 - 0.5f * r.ears);
}

/// Pores in mm: round and close together on the nose, wide and drawn out down the cheeks beside it, small and few on chin and forehead.
float pores(const glm::vec3& p, const Regions& r, float texelMm, std::uint32_t seed) {
    const float patch = glm::mix(0.3f, 1.0f, patches(p, 8, seed + 40));
    float depth = 0;
    if (r.nose > 0.02f) depth += 0.07f * r.nose * twicePits(p, 0.9f, 0.225f, 0.95f, seed) * resolved(0.42f, texelMm);
    if (r.cheeks > 0.02f) {
        const std::uint32_t side = p.x < 0 ? 50 : 0;
        const glm::vec3 drawn = alongCheek(p) / glm::vec3(1.5f, 1, 1);
        depth += 0.085f * r.cheeks * patch * twicePits(drawn, 1.15f, 0.285f, 0.8f, seed + 5 + side) * resolved(0.5f, texelMm);
    }
    const float few = std::max(0.8f * r.chin, 0.55f * r.forehead + 0.45f * r.tZone);
    if (few > 0.02f) depth += 0.05f * few * patch * pits(p, 1.0f, 0.2f, 0.5f, seed + 10) * resolved(0.38f, texelMm);
    return depth * (1 - 0.8f * r.lids);
}

/// Grooves where a noise crosses zero, `width` in units of the noise's value. (Its lattice is kept off the face's planes: there it is
/// zero.)
float grooves(const glm::vec3& q, float width, std::uint32_t seed) {
    const float t = gradientNoise(q + glm::vec3(0.41f, 0.29f, 0.53f), seed) / width;
    return std::exp(-t * t);
}

/// Lines of expression, faint: forehead, lids and under the eyes, neck.
float creases(const glm::vec3& p, const Regions& r, const Eyeball& eye, std::uint32_t seed) {
    float depth = 0;
    if (r.forehead > 0.01f) {
        const float wander = 3.5f * gradientNoise(p / 19.0f, seed);
        const float broken = glm::smoothstep(-0.05f, 0.5f, gradientNoise(glm::vec3(p.x / 17, p.y / 5, 0.3f), seed + 1));
        depth += 0.012f * r.forehead * broken * grooves(glm::vec3(p.x / 47, (p.y + wander) / 8, p.z / 47), 0.14f, seed + 2);
    }
    const float lids = std::max(r.lids, 0.7f * r.underEyes) * (1 - r.lips);
    if (lids > 0.01f) {
        const glm::vec2 d(p.x - eye.centre.x, p.y - eye.centre.y);
        const float angle = std::atan2(d.y, d.x);
        const glm::vec3 q(glm::length(d) / 0.95f, 1.7f * std::cos(angle), 1.7f * std::sin(angle));
        depth += 0.016f * lids * furrows(q, 0.45f, seed + 3) * patches(p, 4, seed + 6);
    }
    if (r.neck > 0.01f) {
        const float wander = 2.5f * gradientNoise(p / 14.0f, seed + 7);
        depth += 0.018f * r.neck * grooves(glm::vec3(p.x / 31, (p.y + wander) / 9, p.z / 31), 0.1f, seed + 4);
    }
    return depth;
}

/// Of the lips: pads between grooves that run across the lip, fork and end; deep ones apart from each other, fine ones among them.
float lipGrooves(const glm::vec3& p, float texelMm, std::uint32_t seed) {
    const glm::vec3 warp(gradientNoise(p / 2.6f, seed), gradientNoise(p / 2.6f, seed + 7), gradientNoise(p / 4.0f, seed + 8));
    const glm::vec3 q = p + glm::vec3(0.75f, 1.2f, 0.8f) * warp;
    const float deep = glm::smoothstep(-0.25f, 0.5f, gradientNoise(glm::vec3(p.x / 3.1f, p.y / 6, p.z / 6) + 0.37f, seed + 3));
    const float fine = glm::smoothstep(-0.4f, 0.4f, gradientNoise(glm::vec3(p.x / 2.3f, p.y / 3, p.z / 3) + 0.71f, seed + 4));
    return 0.075f * deep * furrows(q / glm::vec3(2.3f, 6.5f, 6.5f), 0.33f, seed + 1) +
           0.03f * fine * furrows(q / glm::vec3(1.05f, 3.4f, 3.4f), 0.4f, seed + 2) * resolved(0.5f, texelMm);
}

/// The white is not quite even, and a film of tears stands at the lower lid.
float eyeRelief(const glm::vec3& p, const Face& face, std::uint32_t seed) {
    const float off = glm::length(eyeChart(face.eyeAt(p), p));
    const float white = glm::smoothstep(kIrisRadius, kIrisRadius + 1.5f, off);
    return 0.012f * white * gradientNoise(p / 1.9f, seed + 400) + face.openingAt(p).tears(p);
}

// By region after T. Weyrich et al., Analysis of Human Faces using a Measurement-Based Skin Reflectance Model, 2006, who fitted rho_s and m
// of ten regions of the face: they differ, as sebum and moisture do. The factors are ours, by eye: their table was not at hand.

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

float skinRelief(const glm::vec3& position, const Regions& regions, const Eyeball& eye, float texelMm, std::uint32_t seed) {
    const float bare = 1 - regions.lips;
    float height = bare * (0.016f * fractalNoise(position / 2.2f, 2, seed) + 0.02f * gradientNoise(position / 6.5f, seed + 50));
    const float fine = skinNet(position, regions, texelMm, seed + 100) + pores(position, regions, texelMm, seed + 100);
    height -= bare * (1 - regions.waterline) * fine;
    height -= creases(position, regions, eye, seed + 200);
    if (regions.lips > 0.01f) height -= regions.lips * lipGrooves(position, texelMm, seed + 300);
    return height;
}

glm::vec3 reliefNormal(const SurfacePoint& point, const Face& face, std::uint32_t seed) {
    if (point.part == BustPart::Base) return {0, 0, 1};
    const Regions regions = face.regionsAt(point);
    const Eyeball& eye = face.eyeAt(point.position);
    const auto heightAt = [&](const glm::vec3& p) {
        return point.part == BustPart::Skin ? skinRelief(p, regions, eye, point.texelMm, seed) : eyeRelief(p, face, seed);
    };
    const float step = point.texelMm / 2;
    const auto slope = [&](const glm::vec3& direction) {
        return (heightAt(point.position + step * direction) - heightAt(point.position - step * direction)) / (2 * step);
    };
    return glm::normalize(glm::vec3(-slope(point.tangent), -slope(point.bitangent), 1));
}

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
