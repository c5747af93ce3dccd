#pragma once
// Catmull-Clark subdivision with face-varying texture coordinates, by OpenSubdiv.

#include "host/support/result.h"
#include "meshprep/human/quad_mesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace tegument {

struct Subdivided {
    std::vector<glm::vec3> positions; // on the limit surface
    std::vector<glm::vec3> normals;   // of the limit surface, unit
    std::vector<glm::vec2> uvs;
    std::vector<Quad> quads;
    std::vector<std::uint32_t> parents; // of each quad: the coarse quad that it came from
};

/// `levels` >= 1. Mesh boundaries are sharp (edges and corners keep their place), texture coordinates are smooth inside a chart and along
/// its border, sharp at its corners (E. Catmull and J. Clark 1978; T. DeRose, M. Kass, T. Truong, Subdivision Surfaces in Character
/// Animation, 1998). TG7006 when OpenSubdiv refuses the topology.
[[nodiscard]] Result<Subdivided> subdivide(const std::vector<glm::vec3>& positions, const std::vector<glm::vec2>& uvs,
                                           const std::vector<Quad>& quads, int levels);

} // namespace tegument
