#pragma once
// A mesh under preparation.

#include "host/mesh/mesh.h"

namespace tegument::prep {

/// `point[v]` is the place of vertex v: vertices of one place have the same number, whatever their other attributes. Places are decided
/// once, on the file's own coordinates, and kept through every later step, so that rounding cannot join what was apart.
struct Surface {
    Mesh mesh;
    std::vector<std::uint32_t> point;
    std::uint32_t pointCount = 0;

    [[nodiscard]] std::size_t triangles() const { return mesh.indices.size() / 3; }
    [[nodiscard]] std::uint32_t pointAt(std::size_t corner) const { return point[mesh.indices[corner]]; }
};

} // namespace tegument::prep
