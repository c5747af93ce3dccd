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
        const float wide = radius / spacing * glm::mix(0.55f, 1.0f, random.y);
        const float t = glm::distance(p / spacing, centre) / wide;
        if (t < 1) depth = std::max(depth, (1 - t * t) * (1 - t * t) * glm::mix(0.4f, 1.0f, random.z));
    }
    return depth;
}

/// The net of furrows between polygons of skin: borders of Voronoi cells.
float furrows(const glm::vec3& p, float spacing, std::uint32_t seed) {
    const CellDistances cells = cellNoise(p / spacing, seed);
    return 1 - glm::smoothstep(0.0f, 0.28f, cells.second - cells.nearest);
}

/// Grooves where a noise crosses zero, `width` in units of the noise's value.
float grooves(const glm::vec3& q, float width, std::uint32_t seed) {
    const float t = gradientNoise(q, seed) / width;
    return std::exp(-t * t);
}

/// Pores and furrows in mm below the surface.
float microRelief(const glm::vec3& p, const Regions& r, float texelMm, std::uint32_t seed) {
    const float bare = 1 - r.lips;
    const float pores =
        bare * (0.3f + 0.8f * r.nose + 0.65f * r.cheeks + 0.3f * r.forehead + 0.4f * r.chin) * (1 - 0.7f * r.lids) * (1 - 0.8f * r.ears);
    const float net = bare * (1 - 0.5f * r.ears);
    const glm::vec3 warped =
        p + 0.35f * glm::vec3(gradientNoise(p / 1.7f, seed + 3), gradientNoise(p / 1.7f, seed + 4), gradientNoise(p / 1.7f, seed + 5));
    float depth = 0.07f * pores * pits(p, 1.1f, 0.27f, 0.75f, seed) * resolved(0.5f, texelMm);
    depth += 0.04f * pores * pits(p, 0.6f, 0.15f, 0.8f, seed + 10) * resolved(0.28f, texelMm);
    depth += 0.024f * net * furrows(warped, 1.3f, seed + 20) * resolved(0.6f, texelMm);
    depth += 0.012f * net * furrows(warped, 0.6f, seed + 30) * resolved(0.3f, texelMm);
    return depth;
}

/// Lines of expression, faint: forehead, lids and under the eyes, neck.
float creases(const glm::vec3& p, const Regions& r, const Eyeball& eye, std::uint32_t seed) {
    float depth = 0;
    if (r.forehead > 0.01f) {
        const float wander = 2.5f * gradientNoise(p / 22.0f, seed);
        const float broken = glm::smoothstep(-0.25f, 0.35f, gradientNoise(glm::vec3(p.x / 30, p.y / 6, 0), seed + 1));
        depth += 0.035f * r.forehead * broken * grooves(glm::vec3(p.x / 60, (p.y + wander) / 9, p.z / 60), 0.12f, seed + 2);
    }
    const float lids = std::max(r.lids, r.underEyes) * (1 - r.lips);
    if (lids > 0.01f) {
        const glm::vec2 d(p.x - eye.centre.x, p.y - eye.centre.y);
        const float angle = std::atan2(d.y, d.x);
        depth += 0.03f * lids * grooves(glm::vec3(glm::length(d) / 1.3f, 2.5f * std::cos(angle), 2.5f * std::sin(angle)), 0.16f, seed + 3);
    }
    if (r.neck > 0.01f) depth += 0.025f * r.neck * grooves(glm::vec3(p.x / 16, p.y / 3.2f, p.z / 16), 0.1f, seed + 4);
    return depth;
}

/// Vertical grooves of the lips, forking, wandering a little.
float lipGrooves(const glm::vec3& p, std::uint32_t seed) {
    const float wander = 0.5f * gradientNoise(p / 3.0f, seed);
    const glm::vec3 q((p.x + wander), p.y / 7, p.z / 7);
    return 0.07f * grooves(glm::vec3(q.x / 1.6f, q.y, q.z), 0.18f, seed + 1) +
           0.035f * grooves(glm::vec3(q.x / 0.8f, 1.4f * q.y, 1.4f * q.z), 0.2f, seed + 2);
}

} // namespace

float skinRelief(const glm::vec3& position, const Regions& regions, const Eyeball& eye, float texelMm, std::uint32_t seed) {
    float height = 0.01f * fractalNoise(position / 2.2f, 2, seed) * (1 - regions.lips);
    height -= microRelief(position, regions, texelMm, seed + 100) * (1 - regions.waterline);
    height -= creases(position, regions, eye, seed + 200);
    if (regions.lips > 0.01f) height -= regions.lips * lipGrooves(position, seed + 300);
    return height;
}

glm::vec3 reliefNormal(const SurfacePoint& point, const Face& face, std::uint32_t seed) {
    if (point.part != BustPart::Skin) return {0, 0, 1};
    const Regions regions = face.regionsAt(point);
    const Eyeball& eye = face.eyeAt(point.position);
    const float step = point.texelMm / 2;
    const auto slope = [&](const glm::vec3& direction) {
        const auto at = [&](float offset) { return skinRelief(point.position + offset * direction, regions, eye, point.texelMm, seed); };
        return (at(step) - at(-step)) / (2 * step);
    };
    return glm::normalize(glm::vec3(-slope(point.tangent), -slope(point.bitangent), 1));
}

} // namespace tegument
