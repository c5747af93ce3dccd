#pragma once
// Strands drawn into the maps that shells read: one texture, a sphere map, a cube map. RGBA: empty texels are transparent white, strands
// opaque white (seed 004); where strands differ in length or taper, alpha is the height up to which the texel is covered.

#include "host/image/image.h"
#include "meshprep/fur/strands.h"

#include <array>

namespace tegument {

/// Repeats in both directions without a seam.
[[nodiscard]] Image drawFurTexture(const StrandSet& set, int width, int height, const FurOptions& options);

/// The sphere map of environment mapping: the texel (s, t), t down, shows the direction in which a mirror ball reflects a view along -z,
/// n = (2 s - 1, 1 - 2 t, sqrt(1 - x^2 - y^2)), direction = 2 n_z n - (0, 0, 1). All texels of the disc have one solid angle; its rim is
/// the single direction -z. Texels outside of the disc repeat the rim.
[[nodiscard]] Image drawSphereMap(const StrandSet& set, int side, const FurOptions& options);

/// Six faces in Direct3D's order +X -X +Y -Y +Z -Z. A strand that crosses an edge goes on upon the next face.
[[nodiscard]] std::array<Image, 6> drawCubeMap(const StrandSet& set, int side, const FurOptions& options);

/// The cube map's side whose six faces have about as many texels as a sphere map of this side: both are compared at equal memory.
[[nodiscard]] int cubeMapSide(int sphereMapSide);

/// How many texels of a sphere map show a direction.
[[nodiscard]] std::size_t sphereMapTexels(int side);
[[nodiscard]] std::size_t cubeMapTexels(int side);

/// Unit direction of a texel's centre, and the texel that shows a direction.
[[nodiscard]] glm::dvec3 sphereMapDirection(double s, double t);
[[nodiscard]] glm::dvec2 sphereMapTexture(const glm::dvec3& direction);
[[nodiscard]] glm::dvec3 cubeMapDirection(int face, double u, double v);
struct CubePoint {
    int face = 0;
    glm::dvec2 uv{0};
};
[[nodiscard]] CubePoint cubeMapTexture(const glm::dvec3& direction);

/// Share of the area that is not empty: of the texture, of the sphere of directions.
[[nodiscard]] double coverage(const Image& texture);
[[nodiscard]] double sphereCoverage(const Image& sphereMap);
[[nodiscard]] double cubeCoverage(const std::array<Image, 6>& faces);

/// The six faces unfolded to a cross, four wide and three high, empty squares transparent white.
[[nodiscard]] Image unfoldCube(const std::array<Image, 6>& faces);

} // namespace tegument
