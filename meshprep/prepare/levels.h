#pragma once
// Coarser levels over the same vertices.

#include "host/scene/glb.h"
#include "meshprep/prepare/distance.h"

namespace tegument::prep {

struct Level {
    MeshLevel mesh;
    SurfaceDistance error; // of the full surface's corners and centroids from this level, mm
};

/// At most `count` - 1 levels, each of a quarter of the triangles of the one before; the series ends early where that is not possible, or
/// where fewer than kLeastTriangles would be left. Borders between parts stay where they are, so that no gap opens.
inline constexpr std::size_t kLeastTriangles = 32;
[[nodiscard]] std::vector<Level> makeLevels(const Mesh& mesh, int count);

} // namespace tegument::prep
