#include "lab/reference/surface.h"

#include "meshprep/rays/surface_tree.h"

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

/// Closest point of a triangle (Ericson 2005, "Real-Time Collision Detection", 5.1.5): its distance.
double distanceTo(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double square = glm::dot(normal, normal);
    if (square > 0) {
        const glm::dvec3 ap = p - a;
        const double v = glm::dot(glm::cross(ap, ac), normal) / square;
        const double w = glm::dot(glm::cross(ab, ap), normal) / square;
        if (v >= 0 && w >= 0 && v + w <= 1) return std::abs(glm::dot(ap, normal)) / std::sqrt(square);
    }
    const auto toEdge = [&](const glm::dvec3& from, const glm::dvec3& along) {
        const double length = glm::dot(along, along);
        const double t = length > 0 ? std::clamp(glm::dot(p - from, along) / length, 0.0, 1.0) : 0;
        return glm::length(p - from - t * along);
    };
    return std::min({toEdge(a, ab), toEdge(a, ac), toEdge(b, c - b)});
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

double RayScene::distance(const glm::dvec3& place, double most) const {
    constexpr double kWidened = 1 + 1e-5; // the query is in 32-bit floats
    double found = most;
    tree_->visitNear(glm::vec3(place), static_cast<float>(most * kWidened), [&](std::uint32_t triangle) {
        const auto corner = [&](std::size_t c) {
            return glm::dvec3(mesh_.positions[mesh_.indices[3 * static_cast<std::size_t>(triangle) + c]]);
        };
        found = std::min(found, distanceTo(place, corner(0), corner(1), corner(2)));
        return static_cast<float>(found * kWidened);
    });
    return found;
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
