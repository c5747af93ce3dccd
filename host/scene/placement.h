#pragma once
// Where an object of a scene stands: scaled, turned, moved.

#include "host/mesh/mesh.h"

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace tegument {

/// First `scale` along the mesh's own axes, none 0, an odd number of negative ones mirrors; then `rotation` about the fixed axes x, y and z
/// in this order, counter-clockwise as seen against the axis; then `position`.
struct Placement {
    glm::vec3 position{0}; // mm
    glm::vec3 rotation{0}; // degrees
    glm::vec3 scale{1};

    bool operator==(const Placement&) const = default;
};

/// The row-vector matrix of mul(v, World) (host/scene/view.h).
[[nodiscard]] glm::dmat4 worldMatrix(const Placement& placement);
/// mul(p, m), a point.
[[nodiscard]] glm::dvec3 transformPoint(const glm::dmat4& m, const glm::dvec3& p);

/// Front faces of what stands so are clockwise.
[[nodiscard]] bool isMirrored(const Placement& placement);
/// Lengths along all three axes are scaled alike, whatever their signs.
[[nodiscard]] bool isEvenlyScaled(const Placement& placement);

/// The bounds of a placed mesh: its box taken anew over all vertices; its sphere moved along, or, scaled unevenly, made anew.
[[nodiscard]] Bounds placedBounds(const Mesh& mesh, const Placement& placement);

struct PlacedMesh {
    const Mesh* mesh = nullptr;
    Placement placement;
};
/// Box and minimal sphere of all of them. At least one.
[[nodiscard]] Bounds boundsOfAll(std::span<const PlacedMesh> meshes);

} // namespace tegument
