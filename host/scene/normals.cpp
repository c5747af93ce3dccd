// Vertex normals: the sum of the adjacent face normals weighted by the angle at the vertex (Thuermer and Wuethrich, Computing vertex
// normals from polygonal facets, Journal of Graphics Tools 3(1), 1998), which does not depend on how a flat polygon was cut into triangles.
// Vertices at one position share one normal, so UV seams stay smooth. Double precision throughout: the square of a float length of 1e20 or
// 1e-40 is within its range.

#include "host/scene/mesh.h"
#include "host/scene/welding.h"

#include <array>
#include <cmath>

namespace tegument {

namespace {

/// Angle between two edges, 0 for an edge without length.
double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double length = glm::length(v);
    return length > 0 ? v / length : otherwise;
}

} // namespace

void computeNormals(Mesh& mesh) {
    if (!mesh.normals.empty()) return;
    const std::vector<std::uint32_t> group = weldPositions(mesh.positions);
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
    std::vector<glm::dvec3> anyFace(mesh.positions.size(), glm::dvec3(0, 0, 1)); // where the sum cancels: one of the faces, never NaN
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::array<glm::dvec3, 3> p{};
        for (std::size_t c = 0; c < 3; ++c)
            p[c] = glm::dvec3(mesh.positions[mesh.indices[i + c]]);
        const glm::dvec3 face = unitOr(glm::cross(p[1] - p[0], p[2] - p[0]), glm::dvec3(0));
        if (face == glm::dvec3(0)) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t vertex = group[mesh.indices[i + c]];
            sums[vertex] += face * angleBetween(p[(c + 1) % 3] - p[c], p[(c + 2) % 3] - p[c]);
            anyFace[vertex] = face;
        }
    }
    mesh.normals.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3& sum = sums[group[i]];
        // a sum of two opposite faces is not exactly 0; below 1e-9 only rounding is left of it
        mesh.normals.emplace_back(unitOr(glm::length(sum) > 1e-9 ? sum : glm::dvec3(0), anyFace[group[i]]));
    }
}

} // namespace tegument
