// Vertex normals: the sum of the adjacent face normals weighted by the angle at the vertex (Thuermer and Wuethrich, Computing vertex
// normals from polygonal facets, Journal of Graphics Tools 3(1), 1998), which does not depend on how a flat polygon was cut into triangles.
// Vertices at one position share one normal, so UV seams stay smooth. Double precision throughout: the square of a float length of 1e20 or
// 1e-40 is within its range.

#include "host/mesh/normals.h"
#include "host/mesh/welding.h"
#include "host/support/parallel.h"

#include <algorithm>
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

struct FaceAtCorners {
    glm::dvec3 normal{0};
    std::array<double, 3> angles{};
};

FaceAtCorners faceAtCorners(const std::array<glm::dvec3, 3>& p) {
    FaceAtCorners face{.normal = faceNormal(p)};
    for (std::size_t c = 0; c < 3; ++c)
        face.angles[c] = angleBetween(p[(c + 1) % 3] - p[c], p[(c + 2) % 3] - p[c]);
    return face;
}

} // namespace

std::array<glm::dvec3, 3> cornersOf(const Mesh& mesh, std::size_t triangle) {
    const std::uint32_t* t = &mesh.indices[3 * triangle];
    return {glm::dvec3(mesh.positions[t[0]]), glm::dvec3(mesh.positions[t[1]]), glm::dvec3(mesh.positions[t[2]])};
}

glm::dvec3 faceNormal(const std::array<glm::dvec3, 3>& corners) {
    return unitOr(glm::cross(corners[1] - corners[0], corners[2] - corners[0]), glm::dvec3(0));
}

bool hasArea(const Mesh& mesh) {
    if (std::ranges::any_of(mesh.parts, &MeshPart::expanded)) return true;
    for (std::size_t i = 0; i < mesh.indices.size() / 3; ++i)
        if (faceNormal(cornersOf(mesh, i)) != glm::dvec3(0)) return true;
    return false;
}

std::vector<glm::vec3> angleWeightedNormals(const Mesh& mesh, std::span<const std::uint32_t> groupOfVertex) {
    std::size_t groups = 0;
    for (const std::uint32_t group : groupOfVertex)
        groups = std::max<std::size_t>(groups, std::size_t{group} + 1);
    std::vector<glm::dvec3> sums(groups, glm::dvec3(0));
    std::vector<glm::vec3> anyFace(groups, glm::vec3(0, 0, 1)); // where the sum cancels: one of the faces, never NaN
    const std::size_t triangles = mesh.indices.size() / 3;
    constexpr std::size_t kBlock = 65'536; // at a time, on all processors; the sums are made in the triangles' order
    std::vector<FaceAtCorners> faces(std::min(triangles, kBlock));
    for (std::size_t block = 0; block < triangles; block += kBlock) {
        const std::size_t count = std::min(kBlock, triangles - block);
        inChunks(count, 0, [&](std::size_t first, std::size_t last, std::size_t) {
            for (std::size_t i = first; i < last; ++i)
                faces[i] = faceAtCorners(cornersOf(mesh, block + i));
        });
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t c = 0; c < 3 && faces[i].normal != glm::dvec3(0); ++c) {
                const std::uint32_t group = groupOfVertex[mesh.indices[3 * (block + i) + c]];
                sums[group] += faces[i].normal * faces[i].angles[c];
                anyFace[group] = faces[i].normal;
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
