// Vertex normals: the sum of the adjacent face normals weighted by the angle at the vertex (Thuermer and Wuethrich, Computing vertex
// normals from polygonal facets, Journal of Graphics Tools 3(1), 1998), which does not depend on how a flat polygon was cut into triangles.
// Vertices at one position share one normal, so UV seams stay smooth. Double precision throughout: the square of a float length of 1e20 or
// 1e-40 is within its range.

#include "host/mesh/normals.h"
#include "host/mesh/welding.h"

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

std::array<glm::dvec3, 3> cornersOf(const Mesh& mesh, std::size_t triangle) {
    const std::uint32_t* t = &mesh.indices[3 * triangle];
    return {glm::dvec3(mesh.positions[t[0]]), glm::dvec3(mesh.positions[t[1]]), glm::dvec3(mesh.positions[t[2]])};
}

glm::dvec3 faceNormal(const std::array<glm::dvec3, 3>& corners) {
    return unitOr(glm::cross(corners[1] - corners[0], corners[2] - corners[0]), glm::dvec3(0));
}

std::vector<glm::vec3> angleWeightedNormals(const Mesh& mesh, std::span<const std::uint32_t> groupOfVertex) {
    std::size_t groups = 0;
    for (const std::uint32_t group : groupOfVertex)
        groups = std::max<std::size_t>(groups, std::size_t{group} + 1);
    std::vector<glm::dvec3> sums(groups, glm::dvec3(0));
    std::vector<glm::vec3> anyFace(groups, glm::vec3(0, 0, 1)); // where the sum cancels: one of the faces, never NaN
    for (std::size_t triangle = 0; triangle < mesh.indices.size() / 3; ++triangle) {
        const auto p = cornersOf(mesh, triangle);
        const glm::dvec3 face = faceNormal(p);
        if (face == glm::dvec3(0)) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t group = groupOfVertex[mesh.indices[3 * triangle + c]];
            sums[group] += face * angleBetween(p[(c + 1) % 3] - p[c], p[(c + 2) % 3] - p[c]);
            anyFace[group] = face;
        }
    }
    std::vector<glm::vec3> normals;
    normals.reserve(mesh.positions.size());
    for (const std::uint32_t group : groupOfVertex) {
        // a sum of two opposite faces is not exactly 0; below 1e-9 only rounding is left of it
        const glm::dvec3& sum = sums[group];
        normals.push_back(glm::length(sum) > 1e-9 ? glm::vec3(glm::normalize(sum)) : anyFace[group]);
    }
    return normals;
}

void computeNormals(Mesh& mesh) {
    if (mesh.normals.empty()) mesh.normals = angleWeightedNormals(mesh, weldPositions(mesh.positions));
}

} // namespace tegument
