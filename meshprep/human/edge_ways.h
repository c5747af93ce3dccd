#pragma once
// Shortest ways along the edges of a mesh (E. W. Dijkstra, A Note on Two Problems in Connexion with Graphs, 1959).

#include "meshprep/human/quad_mesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace tegument {

struct EdgeWays {
    std::vector<float> length;         // of each vertex: to the nearest source; `reach` where it is farther
    std::vector<std::uint32_t> source; // of each vertex nearer than `reach`: that source
};

[[nodiscard]] EdgeWays waysAlongEdges(const std::vector<glm::vec3>& positions, const std::vector<Quad>& quads,
                                      const std::vector<std::uint32_t>& sources, float reach);

} // namespace tegument
