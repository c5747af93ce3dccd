#include "meshprep/fur/roots/surface_figures.h"

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
