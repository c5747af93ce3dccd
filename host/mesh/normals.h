#pragma once
// Normals of faces and of groups of vertices, in double precision.

#include "host/mesh/mesh.h"

#include <array>
#include <span>

namespace tegument {

/// The corners of a triangle in double precision. The square of a float length of 1e20 or 1e-40 is within its range.
[[nodiscard]] std::array<glm::dvec3, 3> cornersOf(const Mesh& mesh, std::size_t triangle);

/// Unit, to the side from which the corners run counter-clockwise; 0 for a triangle without area.
[[nodiscard]] glm::dvec3 faceNormal(const std::array<glm::dvec3, 3>& corners);

/// One triangle has an area, in the floats that the mesh holds. Parts that a shader expands have none before, and count.
[[nodiscard]] bool hasArea(const Mesh& mesh);

/// For each vertex the sum of the adjacent face normals weighted by their angle there, made unit; vertices of one group share it.
/// Where the sum cancels it is the normal of one of the faces; (0, 0, 1) where no face has an area.
[[nodiscard]] std::vector<glm::vec3> angleWeightedNormals(const Mesh& mesh, std::span<const std::uint32_t> groupOfVertex);

} // namespace tegument
