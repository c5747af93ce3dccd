#pragma once
// Where hair grows on a human head: scalp, brows and beard, by measures from the eyes.

#include "host/mesh/mesh.h"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace tegument {

/// At each vertex of the mesh.
struct HeadHair {
    std::vector<glm::dvec3> density;   // share of the scalp's, in red
    std::vector<glm::dvec3> length;    // share of the longest, in red
    std::vector<glm::dvec3> direction; // in which it lies, along the skin, as maps hold it: mesh space, 0.5 is 0
};

/// Of a head that looks along +z, with y up and its eyeballs as part "eyes", as `tegument prep human` makes it. Nothing where the mesh has
/// no such part on both sides.
[[nodiscard]] std::optional<HeadHair> hairOfHead(const Mesh& mesh);

} // namespace tegument
