#include "lab/reference/surface.h"

#include <algorithm>
#include <cmath>

namespace tegument::reference {

namespace {

template <class Vectors>
auto corner(const Mesh& mesh, const Vectors& vectors, std::uint32_t triangle, std::size_t c) {
    return vectors[mesh.indices[3 * static_cast<std::size_t>(triangle) + c]];
}

template <class Wide, class Vectors>
Wide mix(const Mesh& mesh, const Vectors& vectors, const Place& place) {
    Wide sum(0);
    for (std::size_t c = 0; c < 3; ++c)
        sum += place.weights[static_cast<int>(c)] * Wide(corner(mesh, vectors, place.triangle, c));
    return sum;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

struct Uvs {
    glm::dvec2 a, b, c;

    Uvs(const Mesh& mesh, std::uint32_t triangle)
        : a(corner(mesh, mesh.uvs, triangle, 0)), b(corner(mesh, mesh.uvs, triangle, 1)), c(corner(mesh, mesh.uvs, triangle, 2)) {}

    [[nodiscard]] double area() const { return cross(b - a, c - a); }
    [[nodiscard]] glm::dvec3 weights(const glm::dvec2& p) const {
        const double whole = area();
        const double wb = cross(p - a, c - a) / whole;
        const double wc = cross(b - a, p - a) / whole;
        return {1 - wb - wc, wb, wc};
    }
};

/// Texels whose centres a triangle covers, borders included.
void drawTriangle(const Mesh& mesh, std::uint32_t triangle, Unwrapped& out) {
    const Uvs uvs(mesh, triangle);
    if (uvs.area() == 0) return;
    const glm::dvec2 low = glm::min(uvs.a, glm::min(uvs.b, uvs.c)) * static_cast<double>(out.size) - 0.5;
    const glm::dvec2 high = glm::max(uvs.a, glm::max(uvs.b, uvs.c)) * static_cast<double>(out.size) - 0.5;
    const auto from = [&](double x) { return std::max(0, static_cast<int>(std::ceil(x))); };
    const auto to = [&](double x) { return std::min(out.size - 1, static_cast<int>(std::floor(x))); };
    for (int y = from(low.y); y <= to(high.y); ++y)
        for (int x = from(low.x); x <= to(high.x); ++x) {
            const glm::dvec3 weights = uvs.weights((glm::dvec2(x, y) + 0.5) / static_cast<double>(out.size));
            if (std::min({weights.x, weights.y, weights.z}) < 0) continue;
            out.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(out.size) + static_cast<std::size_t>(x)] =
                Place{triangle, weights};
        }
}

} // namespace

SurfacePoint interpolate(const Mesh& mesh, const Place& place) {
    SurfacePoint point{.place = place, .position = mix<glm::dvec3>(mesh, mesh.positions, place)};
    if (!mesh.normals.empty()) point.normal = mix<glm::dvec3>(mesh, mesh.normals, place);
    if (!mesh.tangents.empty()) point.tangent = mix<glm::dvec4>(mesh, mesh.tangents, place);
    if (!mesh.uvs.empty()) point.uv = mix<glm::dvec2>(mesh, mesh.uvs, place);
    return point;
}

glm::dvec3 outsideFacet(const Mesh& mesh, const SurfacePoint& point) {
    if (mesh.normals.empty()) return point.position;
    glm::dvec3 raised = point.position;
    for (std::size_t c = 0; c < 3; ++c) {
        const glm::dvec3 from = point.position - glm::dvec3(corner(mesh, mesh.positions, point.place.triangle, c));
        const glm::dvec3 normal(corner(mesh, mesh.normals, point.place.triangle, c));
        raised -= point.place.weights[static_cast<int>(c)] * std::min(0.0, glm::dot(from, normal)) * normal;
    }
    return raised;
}

glm::dvec3 faceNormal(const Mesh& mesh, std::uint32_t triangle) {
    const glm::dvec3 a = corner(mesh, mesh.positions, triangle, 0);
    const glm::dvec3 b = corner(mesh, mesh.positions, triangle, 1);
    const glm::dvec3 c = corner(mesh, mesh.positions, triangle, 2);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    return length > 0 ? normal / length : glm::dvec3(0);
}

std::optional<Jacobian> jacobian(const Mesh& mesh, std::uint32_t triangle) {
    const Uvs uvs(mesh, triangle);
    const double area = uvs.area();
    if (area == 0) return std::nullopt;
    const glm::dvec3 a = corner(mesh, mesh.positions, triangle, 0);
    const glm::dvec3 p = glm::dvec3(corner(mesh, mesh.positions, triangle, 1)) - a;
    const glm::dvec3 q = glm::dvec3(corner(mesh, mesh.positions, triangle, 2)) - a;
    const glm::dvec2 s = uvs.b - uvs.a;
    const glm::dvec2 t = uvs.c - uvs.a;
    // [p q] = [Pu Pv] [s t]: Cramer's rule.
    return Jacobian{(p * t.y - q * s.y) / area, (q * s.x - p * t.x) / area};
}

Unwrapped unwrap(const Mesh& mesh, int size) {
    Unwrapped out{.size = size};
    out.texels.resize(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (std::uint32_t triangle = 0; 3 * static_cast<std::size_t>(triangle) < mesh.indices.size(); ++triangle)
        drawTriangle(mesh, triangle, out);
    return out;
}

} // namespace tegument::reference
