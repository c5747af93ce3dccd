#pragma once
// Roots as strands need them: read from their texture, brought to the mesh that is drawn, in an order that keeps neighbours
// together: ribbons are blended in this order, and others err more (docs/design/fur.md).

#include "host/image/image.h"
#include "host/mesh/mesh.h"

#include <span>
#include <vector>

namespace tegument {

/// Lengths in units of the mesh's ball, from its centre.
struct RootedPlace {
    glm::vec3 position{0};
    glm::vec3 normal{0, 0, 1};
    float address = 0;        // of its texels
    std::uint32_t number = 0; // in their order
};

struct RootedMesh {
    const Mesh& mesh;
    std::vector<RootedPlace> roots; // along a Z-order curve (G. Morton, 1966), in each of its blocks by the axis that they look along
    float spacing = 0;              // mean distance of roots at full density
};

/// `texture` as `tegument fur roots` writes it, of this mesh in any unit. TG7109 it holds no roots.
[[nodiscard]] Result<RootedMesh> readRooted(const Mesh& mesh, const Image& texture, unsigned threads = 0);

} // namespace tegument
