// Balls and cones of clusters.

#include "host/mesh/pose.h"

#include <algorithm>
#include <span>

namespace tegument {

namespace {

/// A mesh, and its pose where it has one.
struct Seen {
    const Mesh& mesh;
    std::optional<PoseView> pose;

    [[nodiscard]] glm::dvec3 position(std::uint32_t i) const { return pose ? pose->position(i) : glm::dvec3(mesh.positions[i]); }
    [[nodiscard]] glm::dvec3 normal(std::uint32_t i) const { return pose ? pose->normal(i) : glm::dvec3(mesh.normals[i]); }
};

/// The ball around the box of the vertices: at most 1.73 times the radius of the smallest, found in one pass.
void addBall(const Seen& mesh, std::span<const std::uint32_t> corners, MeshCluster& cluster) {
    glm::dvec3 low = mesh.position(corners.front());
    glm::dvec3 high = low;
    for (const std::uint32_t corner : corners) {
        low = glm::min(low, mesh.position(corner));
        high = glm::max(high, mesh.position(corner));
    }
    cluster.centre = glm::vec3((low + high) / 2.0);
    double radius = 0;
    for (const std::uint32_t corner : corners)
        radius = std::max(radius, glm::distance(glm::dvec3(cluster.centre), mesh.position(corner)));
    cluster.radius = static_cast<float>(radius * (1 + 1e-6)); // no vertex lies outside after rounding
}

/// Around the mean normal. Normals that cancel leave none out: the cone holds every direction.
void addCone(const Seen& mesh, std::span<const std::uint32_t> corners, MeshCluster& cluster) {
    glm::dvec3 sum(0);
    for (const std::uint32_t corner : corners)
        sum += mesh.normal(corner);
    const double length = glm::length(sum);
    if (!(length > 1e-6 * static_cast<double>(corners.size()))) return;
    const glm::dvec3 axis = sum / length;
    double cosine = 1;
    for (const std::uint32_t corner : corners)
        cosine = std::min(cosine, glm::dot(axis, mesh.normal(corner)));
    cluster.axis = glm::vec3(axis);
    cluster.cosine = static_cast<float>(std::max(cosine - 1e-6, -1.0)); // as above
}

} // namespace

void computeClusters(const Mesh& mesh, MeshPart& part) {
    const Seen seen{.mesh = mesh, .pose = poseOf(mesh)};
    for (MeshCluster& cluster : part.clusters) {
        const auto corners = std::span(mesh.indices).subspan(part.firstIndex + cluster.firstIndex, cluster.indexCount);
        if (corners.empty()) continue;
        addBall(seen, corners, cluster);
        addCone(seen, corners, cluster);
    }
}

} // namespace tegument
