#pragma once
// How evenly strands lie that are looked up by the rest position: at roots on the surface (T3), or where the surface cuts balls in space
// (T2).

#include "meshprep/prepare/patches.h"
#include "meshprep/prepare/surface.h"

#include <string>

namespace tegument::prep {

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
