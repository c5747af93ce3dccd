#include "meshprep/fur/roots/fur_surface.h"

#include "meshprep/base/noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

/// Levels of detail that `tegument prep` makes of one mesh differ by less (tests/fur/roots/surface_figures_test.cpp). Roots are 0.01 of the
/// radius apart, so those of a surface that lies this far off are still found.
constexpr double kPlaces = 0.01;
/// Coarser levels lose wrinkles, and with them area.
constexpr double kArea = 0.05;

double greatest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

} // namespace

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

SurfaceFigures surfaceFigures(const Mesh& mesh) {
    SurfaceFigures figures;
    const double radius = mesh.bounds.radius > 0 ? static_cast<double>(mesh.bounds.radius) : 1;
    const auto place = [&](std::size_t corner) {
        return (glm::dvec3(mesh.positions[mesh.indices[corner]]) - glm::dvec3(mesh.bounds.centre)) / radius;
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = place(i);
        const glm::dvec3 b = place(i + 1);
        const glm::dvec3 c = place(i + 2);
        const double area = glm::length(glm::cross(b - a, c - a)) / 2;
        figures.area += area;
        figures.middle += area / 3 * (a + b + c);
        figures.spread += area / 6 * (a * a + b * b + c * c + a * b + b * c + c * a); // the mean of x^2 over a triangle
    }
    if (!(figures.area > 0)) return figures;
    figures.middle /= figures.area;
    figures.spread /= figures.area;
    return figures;
}

std::optional<std::string> whyNotSame(const SurfaceFigures& made, const SurfaceFigures& drawn) {
    if (std::abs(made.area - drawn.area) > kArea * drawn.area)
        return fmt::format("their mesh has an area of {:.4g} squares of its radius, this one of {:.4g}", made.area, drawn.area);
    if (greatest(made.middle - drawn.middle) > kPlaces)
        return fmt::format(
            "the middle of their mesh is ({:.3f}, {:.3f}, {:.3f}) radii from its ball's centre, of this one ({:.3f}, {:.3f}, {:.3f})",
            made.middle.x, made.middle.y, made.middle.z, drawn.middle.x, drawn.middle.y, drawn.middle.z);
    if (greatest(made.spread - drawn.spread) > kPlaces)
        return fmt::format(
            "their mesh spreads by ({:.3f}, {:.3f}, {:.3f}) squares of its radius along its axes, this one by ({:.3f}, {:.3f}, {:.3f})",
            made.spread.x, made.spread.y, made.spread.z, drawn.spread.x, drawn.spread.y, drawn.spread.z);
    return std::nullopt;
}

} // namespace tegument
