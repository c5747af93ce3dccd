#include "meshprep/fur/ribbons/below.h"

#include <algorithm>

namespace tegument {

namespace {

constexpr float kDepth = 0.02F; // radii: how far from its triangle a root may lie

} // namespace

Below::Below(const FurSurface& surface, unsigned threads)
    : surface_(surface), tree_(surface.positions(), surface.mesh().indices, {.quick = true, .threads = threads == 1 ? 1U : 0U}) {}

std::optional<SurfacePoint> Below::found(const RootedPlace& root) const {
    const auto hit = tree_.nearest(root.position + kDepth * root.normal, -root.normal, {.first = 0, .last = 2 * kDepth});
    if (!hit) return std::nullopt;
    return surface_.at(hit->face, barycentric(hit->face, root.position));
}

SurfacePoint Below::at(const RootedPlace& root) const {
    return found(root).value_or(SurfacePoint{.position = root.position, .normal = root.normal});
}

glm::vec2 Below::barycentric(std::uint32_t triangle, const glm::vec3& place) const {
    const std::uint32_t* corner = &surface_.mesh().indices[3 * std::size_t{triangle}];
    const glm::vec3 a = surface_.positions()[corner[0]];
    const glm::vec3 u = surface_.positions()[corner[1]] - a;
    const glm::vec3 v = surface_.positions()[corner[2]] - a;
    const glm::vec3 n = glm::cross(u, v);
    const float square = std::max(glm::dot(n, n), 1e-30F);
    const glm::vec2 weights(glm::dot(glm::cross(place - a, v), n) / square, glm::dot(glm::cross(u, place - a), n) / square);
    const glm::vec2 inside = glm::max(weights, glm::vec2(0));
    return inside / std::max(inside.x + inside.y, 1.0F);
}

} // namespace tegument
