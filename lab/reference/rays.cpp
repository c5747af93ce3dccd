#include "lab/reference/surface.h"

#include "host/support/rays/surface_tree.h"

#include <algorithm>

namespace tegument::reference {

namespace {

/// Where the ray meets the plane of the triangle.
Hit refine(const Mesh& mesh, std::uint32_t triangle, const glm::dvec3& origin, const glm::dvec3& direction) {
    const auto corner = [&](std::size_t c) { return glm::dvec3(mesh.positions[mesh.indices[3 * static_cast<std::size_t>(triangle) + c]]); };
    const glm::dvec3 a = corner(0);
    const glm::dvec3 p = corner(1) - a;
    const glm::dvec3 q = corner(2) - a;
    const glm::dvec3 normal = glm::cross(p, q);
    const double distance = glm::dot(a - origin, normal) / glm::dot(direction, normal);
    const glm::dvec3 within = origin + distance * direction - a;
    const double square = glm::dot(normal, normal);
    const double wb = glm::dot(glm::cross(within, q), normal) / square;
    const double wc = glm::dot(glm::cross(p, within), normal) / square;
    return {{triangle, {1 - wb - wc, wb, wc}}, distance};
}

} // namespace

RayScene::RayScene(const Mesh& mesh)
    : mesh_(mesh), tree_(std::make_unique<SurfaceTree>(mesh.positions, mesh.indices, TreeOptions{.watertight = true})) {}

RayScene::~RayScene() = default;

std::optional<Hit> RayScene::nearest(const glm::dvec3& origin, const glm::dvec3& direction) const {
    const auto hit = tree_->nearest(glm::vec3(origin), glm::vec3(direction));
    if (!hit) return std::nullopt;
    return refine(mesh_, hit->face, origin, direction);
}

bool RayScene::reaches(const glm::dvec3& light, const glm::dvec3& point, double slack) const {
    const double distance = glm::length(point - light);
    const auto hit = nearest(light, (point - light) / distance);
    return !hit || hit->distance > distance - slack;
}

std::vector<std::uint32_t> RayScene::around(const glm::dvec3& centre, double radius) const {
    constexpr double kWidened = 1 + 1e-5; // the query is in 32-bit floats
    const auto widened = static_cast<float>(radius * kWidened);
    std::vector<std::uint32_t> found;
    tree_->visitNear(glm::vec3(centre), widened, [&](std::uint32_t triangle) {
        found.push_back(triangle);
        return widened;
    });
    std::ranges::sort(found);
    return found;
}

} // namespace tegument::reference
