#pragma once
// Triangles with corners in two index spaces, and a level cut through them.
// Shortest ways along the edges of a mesh (E. W. Dijkstra, A Note on Two Problems in Connexion with Graphs, 1959).

#include "meshprep/human/bust.h"
#include "meshprep/human/quad_mesh.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace tegument {

struct CornerTriangle {
    std::array<std::uint32_t, 3> position{};
    std::array<std::uint32_t, 3> uv{};
    BustPart part = BustPart::Skin;
};

struct TriangleSurface {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; // unit, of each position
    std::vector<glm::vec2> uvs;     // v up
    std::vector<CornerTriangle> triangles;
};

/// Cuts away what lies below y = `height`. New vertices lie exactly on the plane; vertices within 0.05 mm of it are moved onto it, so that
/// no sliver is left.
void cutBelow(TriangleSurface& surface, float height);

/// Closes the hole that lies in the plane y = `height` by a fan around its centre, facing down, of part Base, with coordinates (x, z) in
/// mm. Returns the number of triangles added.
std::size_t closeBase(TriangleSurface& surface, float height);

struct EdgeWays {
    std::vector<float> length;         // of each vertex: to the nearest source; `reach` where it is farther
    std::vector<std::uint32_t> source; // of each vertex nearer than `reach`: that source
};

[[nodiscard]] EdgeWays waysAlongEdges(const std::vector<glm::vec3>& positions, const std::vector<Quad>& quads,
                                      const std::vector<std::uint32_t>& sources, float reach);

} // namespace tegument
