#pragma once
// Where fur is combed to, and where it is short, on a mesh that nobody has painted. docs/design/fur.md, "Flow".

#include "meshprep/fur/ribbons/rooted.h"

#include <optional>
#include <span>
#include <vector>

namespace tegument {

struct FlowOptions {
    std::optional<glm::dvec3> comb;  // mesh space, any length; none: from the mesh's shape
    glm::dvec3 down{0, -1, 0};       // mesh space
    std::span<const glm::vec3> told; // a direction for each root, perpendicular to its normal, at most 1 long; or none
    bool thickness = true;           // `shortness` is asked for
};

struct CoatFlow {
    std::vector<glm::vec3> direction; // of each root: perpendicular to its normal, at most 1 long; short where the coat parts or meets
    std::vector<float> shortness;     // of each root: 0 a body's long fur, 1 that of ears, paws and noses
    glm::dvec3 comb{0};               // unit, mesh space: what the field follows; one from the shape turns up on the head
};

/// `rooted`: in the order of a curve through space, so that every n-th is spread over the mesh. `mesh`: what thickness is measured on.
[[nodiscard]] CoatFlow flowOfCoat(const RootedMesh& rooted, const FlowOptions& options, unsigned threads = 0);

/// From the head to the tail and down: along the longest horizontal axis, from where the surface stands higher. The rounder the mesh seen
/// from above, the more of it is down.
[[nodiscard]] glm::dvec3 combOfShape(std::span<const glm::vec3> positions, const glm::dvec3& down);

} // namespace tegument
