#include "meshprep/fur/roots/fur_surface.h"

#include "meshprep/base/noise.h"

#include <algorithm>
#include <cmath>

namespace tegument {

FurSurface::FurSurface(const Mesh& mesh) : mesh_(mesh) {
    centre_ = glm::dvec3(mesh.bounds.centre);
    radius_ = mesh.bounds.radius > 0 ? static_cast<double>(mesh.bounds.radius) : 1.0;
    positions_.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions)
        positions_.emplace_back((glm::dvec3(p) - centre_) / radius_);
    addAreas();
}

void FurSurface::addAreas() {
    const std::size_t count = mesh_.indices.size() / 3;
    cumulative_.reserve(count);
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t* t = &mesh_.indices[3 * i];
        const glm::dvec3 a(positions_[t[0]]);
        sum += glm::length(glm::cross(glm::dvec3(positions_[t[1]]) - a, glm::dvec3(positions_[t[2]]) - a)) / 2;
        cumulative_.push_back(sum);
    }
    std::uint32_t triangle = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double from = sum * static_cast<double>(k) / static_cast<double>(count);
        while (triangle + 1 < count && cumulative_[triangle] <= from)
            ++triangle;
        guide_.push_back(triangle);
    }
}

std::uint32_t FurSurface::triangleAt(double area) const {
    const auto parts = static_cast<double>(guide_.size());
    const auto part = static_cast<std::size_t>(std::clamp(area / cumulative_.back() * parts, 0.0, parts - 1));
    std::uint32_t triangle = part > 0 ? guide_[part - 1] : 0; // one part back: the division rounds
    while (triangle + 1 < cumulative_.size() && cumulative_[triangle] <= area)
        ++triangle;
    return triangle;
}

SurfacePoint FurSurface::point(const glm::dvec3& uniform) const {
    const double root = std::sqrt(uniform.y); // R. Osada et al., Shape Distributions, 2002, eq. 1
    return at(triangleAt(uniform.x * area()), glm::vec2(root * (1 - uniform.z), root * uniform.z));
}

SurfacePoint FurSurface::at(std::uint32_t triangle, const glm::vec2& barycentric) const {
    SurfacePoint point{.triangle = triangle, .barycentric = barycentric};
    const std::uint32_t* t = &mesh_.indices[3 * std::size_t{point.triangle}];
    const glm::vec3 weights(1 - point.barycentric.x - point.barycentric.y, point.barycentric);
    point.position = weights.x * positions_[t[0]] + weights.y * positions_[t[1]] + weights.z * positions_[t[2]];
    const glm::vec3 sum = weights.x * mesh_.normals[t[0]] + weights.y * mesh_.normals[t[1]] + weights.z * mesh_.normals[t[2]];
    const float length = glm::length(sum);
    if (length > 1e-6F) {
        point.normal = sum / length;
        return point;
    }
    const glm::dvec3 a(positions_[t[0]]);
    const glm::dvec3 face = glm::cross(glm::dvec3(positions_[t[1]]) - a, glm::dvec3(positions_[t[2]]) - a);
    if (glm::length(face) > 0) point.normal = glm::vec3(glm::normalize(face));
    return point;
}

glm::dvec3 rootNoise(std::uint64_t counter, std::uint32_t seed) {
    constexpr double kWord = 1.0 / 4294967296.0;
    const glm::ivec3 lattice(static_cast<int>(counter & 0x7fffffffU), static_cast<int>((counter >> 31U) & 0x7fffffffU), 0x2f);
    return glm::dvec3(hashLattice(lattice, seed)) * kWord;
}

} // namespace tegument
