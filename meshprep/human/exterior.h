#pragma once
// Which faces of a closed or nearly closed surface can be seen from outside.

#include "meshprep/human/quad_mesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace tegument {

struct ExteriorRays {
    int directions = 256; // evenly spread over the sphere; those on the side of a quad's normal are tried
    int leastLeaving = 3; // so many must leave the mesh: one ray that finds a crack does not make a cavity a part of the outside
};

/// For each quad 1 where, from its centre, at least `leastLeaving` rays leave the mesh without meeting any other quad.
[[nodiscard]] std::vector<std::uint8_t> seenFromOutside(const std::vector<glm::vec3>& positions, const std::vector<Quad>& quads,
                                                        const ExteriorRays& rays = {});

/// The quads that are safe to take away: unseen ones in a patch (quads joined by edges) of at least `leastPatch` quads, whose corners are
/// all farther than `rim` from every seen quad, measured along edges.
[[nodiscard]] std::vector<std::uint8_t> hiddenPatches(const std::vector<glm::vec3>& positions, const std::vector<Quad>& quads,
                                                      const std::vector<std::uint8_t>& seen, std::size_t leastPatch, float rim);

} // namespace tegument
