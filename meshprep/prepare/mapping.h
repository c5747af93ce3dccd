#pragma once
// How evenly textures lie on a mesh: by its own texture coordinates, and by the vectors with which the source document looks fur up.
// How evenly strands lie that are looked up by the rest position: at roots on the surface (T3), or where the surface cuts balls in space
// (T2).

#include "meshprep/prepare/patches.h"
#include "meshprep/prepare/surface.h"

#include <string>

namespace tegument::prep {

/// Shares are of the mesh's area. Density is texels per area; CV is its standard deviation over its mean, weighted by area.
struct MappingFigures {
    std::string name;
    double cvFace = 0;
    double cvPatch = 0;  // over kPatches patches of about equal size
    double density1 = 0; // percentiles of density / mean
    double density50 = 0;
    double density99 = 0;
    double anisotropy50 = 0; // greater over lesser stretch of a triangle; percentiles
    double anisotropy95 = 0;
    double starved = 0;                   // below 5 % of the mean density
    double mirrored = 0;                  // seen from the other side than most
    double oneTexel = 0;                  // triangles with all corners in one texel
    double seamLength = 0;                // over the square root of the area
    std::optional<double> seamJumpTexels; // mean distance of the two sides of a seam; of texture coordinates only
};

inline constexpr int kMappingTexels = 1024; // side of the texture, or of each of its charts

/// One entry per way: the mesh's own coordinates if it has some, then {position, normal, sum of both} x {sphere map, cube map, two
/// equal-area discs}. The mesh must be centred and have normals.
[[nodiscard]] std::vector<MappingFigures> examineMapping(const Surface& surface);

/// Shares are of the mesh's area.
struct RootMapping {
    std::string name;
    std::size_t count = 0; // strands
    double cvPatch = 0;    // of the count per area over kPatches patches
    double poissonCv = 0;  // what independent places would give: sqrt(patches / count)
    double starved = 0;    // no strand within the disc that would hold one at 5 % of the density: sqrt(1 / (0.05 pi)) = 2.52 spacings
    double largestGap = 0; // greatest distance of a sampled place from its nearest strand, spacings
    double seamLength = 0; // edges at which the look-up vector differs between the two sides, over the square root of the area
};

inline constexpr std::size_t kMappedRoots = 70'000;

/// T3, then T2. The mesh must have bounds and normals.
[[nodiscard]] std::vector<RootMapping> examineRoots(const Surface& surface, std::size_t count = kMappedRoots);

} // namespace tegument::prep
