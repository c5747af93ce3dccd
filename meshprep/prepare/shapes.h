#pragma once
// Meshes with known counts, to try preparation on: the source document's two small ones, and two large ones with the roughness of scans.

#include "host/mesh/mesh.h"

#include <string_view>

namespace tegument::prep {

enum class Shape {
    Cube,   // 12 triangles that share nothing
    Torus,  // 2 * 16 * 12 triangles that share nothing
    Sphere, // 20 * detail^2: an icosahedron's faces cut regularly, pushed out to the sphere and displaced by noise
    Terrain // 2 * detail^2: a square grid, raised by noise
};

/// The detail for about a million triangles, as in the published figures.
inline constexpr int kSphereDetail = 224;
inline constexpr int kTerrainDetail = 724;

/// 0: the detail above. Cube and torus have none.
[[nodiscard]] Mesh makeShape(Shape shape, int detail = 0);

} // namespace tegument::prep
