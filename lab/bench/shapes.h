#pragma once
// Bodies made from formulas: the meshes of the named scenes. Millimetres, each patch in a chart of its own with nearly equal texels.

#include "host/mesh/mesh.h"

#include <optional>

namespace tegument::bench {

/// A square of 60 mm in the plane z = 0 and a block on its left whose upper edge, lit from the left at `angle` degrees from the plane's
/// normal, throws its shadow's border to x = 0.
[[nodiscard]] Mesh planeWithEdge(double angle);
/// The same square under a plate with a round hole of 4 mm radius: lit likewise, the hole's light falls around the origin.
[[nodiscard]] Mesh planeWithDisc(double angle);
/// Front and back in a chart each; their seam is the outline seen along z.
[[nodiscard]] Mesh sphere(double radius, int quads = 96);
/// Upright, 20 mm wide and 40 mm high, with flat ends.
[[nodiscard]] Mesh cylinder();
/// Two upright ellipsoids, 16 mm wide and 32 mm high, that touch in the origin, each in six charts with seams on all sides.
[[nodiscard]] Mesh lobes();

/// Adds a bar between the mesh and a light: across the direction to the light, 1.6 radii from the centre, an eighth of the radius thick.
/// Its texels take the largest free square of the texture; false where there is none of a 64th of its side.
[[nodiscard]] bool addBar(Mesh& mesh, const glm::dvec3& toLight);

/// Waves of the normal, 96 along the texture's side and up to 17 degrees high.
[[nodiscard]] Image bumpMap();
/// Light and dark skin in 64 x 64 squares, sRGB.
[[nodiscard]] Image checkerMap();

} // namespace tegument::bench
