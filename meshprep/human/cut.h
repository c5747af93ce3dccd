#pragma once
// Triangles with corners in two index spaces, and a level cut through them.

#include "meshprep/human/bust.h"

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

} // namespace tegument
