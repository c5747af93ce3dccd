#include "meshprep/human/unfold.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace tegument {

namespace {

/// For each chart the mean direction, in texture space, in which y grows on the mesh.
std::vector<glm::dvec2> upDirections(const TriangleSurface& surface, const std::vector<std::uint32_t>& charts) {
    std::vector<glm::dvec2> up(std::size_t{1} + std::ranges::max(charts), glm::dvec2(0));
    for (std::size_t t = 0; t < charts.size(); ++t) {
        const CornerTriangle& triangle = surface.triangles[t];
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t next = (c + 1) % 3;
            const float rise = surface.positions[triangle.position[next]].y - surface.positions[triangle.position[c]].y;
            up[charts[t]] += glm::dvec2((surface.uvs[triangle.uv[next]] - surface.uvs[triangle.uv[c]]) * rise);
        }
    }
    return up;
}

/// By the quarter turn that brings `up` nearest to (0, 1).
glm::vec2 turnUpright(const glm::vec2& p, const glm::dvec2& up) {
    if (std::abs(up.y) >= std::abs(up.x)) return up.y >= 0 ? p : -p;
    return up.x >= 0 ? glm::vec2(-p.y, p.x) : glm::vec2(p.y, -p.x);
}

struct Foremost {
    std::uint32_t chart = 0;
    std::uint32_t uv = 0;
};

/// Of the skin; nothing where there is none.
std::optional<Foremost> foremostPoint(const TriangleSurface& surface, const std::vector<std::uint32_t>& charts) {
    std::optional<Foremost> result;
    float z = std::numeric_limits<float>::lowest();
    for (std::size_t t = 0; t < charts.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            const float here = surface.positions[surface.triangles[t].position[c]].z;
            if (surface.triangles[t].part != BustPart::Skin || here <= z) continue;
            z = here;
            result = Foremost{.chart = charts[t], .uv = surface.triangles[t].uv[c]};
        }
    return result;
}

} // namespace

glm::vec2 widenFace(const glm::vec2& p, const glm::vec2& centre, float halfWidth) {
    constexpr float kAcross = 0.4f;
    constexpr float kFar = 0.9f;
    constexpr float kNear = 0.7f;
    const float s = (p.x - centre.x) / halfWidth;
    const float sigma = 0.28f * halfWidth;
    const float dy = p.y - centre.y;
    const float bell = sigma * std::sqrt(std::numbers::pi_v<float> / 2) * std::erf(dy / (sigma * std::numbers::sqrt2_v<float>));
    return {centre.x + halfWidth * s * (1 + kAcross) / (1 + kAcross * s * s), centre.y + kFar * dy + kNear * bell};
}

std::vector<glm::vec2> unfoldCharts(const TriangleSurface& surface, const std::vector<std::uint32_t>& charts) {
    const std::vector<glm::dvec2> up = upDirections(surface, charts);
    std::vector<glm::vec2> plane = surface.uvs;
    std::vector<std::uint8_t> ofFace(plane.size(), 0);
    const std::optional<Foremost> nose = foremostPoint(surface, charts);
    for (std::size_t t = 0; t < charts.size(); ++t)
        for (const std::uint32_t uv : surface.triangles[t].uv) {
            plane[uv] = turnUpright(surface.uvs[uv], up[charts[t]]);
            ofFace[uv] = nose && charts[t] == nose->chart ? 1 : 0;
        }
    if (!nose) return plane;
    const glm::vec2 centre = plane[nose->uv];
    float halfWidth = 0;
    for (std::size_t uv = 0; uv < plane.size(); ++uv)
        if (ofFace[uv] != 0) halfWidth = std::max(halfWidth, std::abs(plane[uv].x - centre.x));
    for (std::size_t uv = 0; uv < plane.size(); ++uv)
        if (ofFace[uv] != 0) plane[uv] = widenFace(plane[uv], centre, halfWidth);
    return plane;
}

} // namespace tegument
