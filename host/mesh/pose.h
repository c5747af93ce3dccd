#pragma once
// A pose of a mesh: where it takes the vertices. It travels as two attributes of the mesh, whose own positions stay those at rest, by which
// maps of it are found. Drawn is the pose; vertices of parts that a shader expands stay at rest, for the shader bends them.

#include "host/mesh/mesh.h"

#include <optional>
#include <span>
#include <vector>

namespace tegument {

/// Points into the mesh.
struct PoseView {
    std::span<const double> positions; // three of each vertex
    std::span<const double> normals;

    [[nodiscard]] glm::dvec3 position(std::size_t vertex) const {
        return {positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]};
    }
    [[nodiscard]] glm::dvec3 normal(std::size_t vertex) const {
        return {normals[3 * vertex], normals[3 * vertex + 1], normals[3 * vertex + 2]};
    }
};

[[nodiscard]] std::optional<PoseView> poseOf(const Mesh& mesh);
/// As many of both as the mesh has vertices. Clusters of its parts become those of the pose.
void setPose(Mesh& mesh, std::span<const glm::vec3> positions, std::span<const glm::vec3> normals);

/// Of the vertices where the pose has them; without one the mesh's own.
[[nodiscard]] Bounds seenBounds(const Mesh& mesh);

/// Whether each vertex belongs to a part that a shader expands; empty where the mesh has no such part.
[[nodiscard]] std::vector<bool> expandedVertices(const Mesh& mesh);

} // namespace tegument
