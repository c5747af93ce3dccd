#pragma once
// How much of the surroundings a mesh hides from itself, texel by texel: by rays.

#include "host/image/image.h"
#include "host/mesh/mesh.h"
#include "host/support/result.h"

namespace tegument {

struct OcclusionOptions {
    int side = 512;         // of the map, texels
    int rays = 256;         // of a texel, 1 to 65536
    double reachMm = 0;     // what is farther away hides nothing; 0: no limit
    std::uint32_t seed = 1; // of the rays' turn from texel to texel
};

/// A change of what is made takes another number: part of names in the cache.
inline constexpr int kOcclusionVersion = 1;

struct Occlusion {
    /// Four channels. Alpha: share of a uniform sky's irradiance that arrives (cosine weighted, about the mesh's normal). Red, green, blue:
    /// the mean direction of the rays that get out, unit, in the mesh's space, stored as 0.5 + 0.5 x; the normal where none gets out.
    /// Texels beside the charts hold those of the nearest one.
    Image map;
    double open = 0;         // mean of alpha over the charts
    std::size_t covered = 0; // texels on charts
    double seconds = 0;
};

/// Rays start a hundred-thousandth of the bounding sphere's radius above the surface. A standard error of alpha a is below
/// sqrt(a (1 - a) / rays): they are stratified. TG7061: the mesh has no texture coordinates in the unit square.
[[nodiscard]] Result<Occlusion> bakeOcclusion(const Mesh& mesh, const OcclusionOptions& options = {});

} // namespace tegument
