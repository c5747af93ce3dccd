#pragma once
// Which vertices are at one place.

#include "meshprep/prepare/surface.h"

namespace tegument::prep {

/// Unless one of these is given: exact (0.0 and -0.0 are equal), and then cracks are closed that are no wider than one step of the file's
/// numbers: along borders only, and by less than a hundredth of the triangles' sides there.
struct SamePlace {
    std::optional<double> epsilon; // mm: at most this far from the first vertex of the place; 0: exact, cracks stay
    std::optional<int> decimals;   // equal when printed with this many decimals, as the source document's programs did
};

struct Places {
    std::size_t joined = 0; // vertices at the place of an earlier one
    std::size_t cracks = 0; // of them: those that were not exactly there, where no epsilon was given
    double crackWidth = 0;  // mm: what was taken for the file's last digit
};

/// Most decimals for which x * 10^n is exact in double precision for every float x, so that rounding it is what printf does.
inline constexpr int kMostDecimals = 12;

/// Fills `point`, and moves each vertex to the first one of its place. `reach`: mm, the greatest coordinate that the file stores as a
/// float; 0: its numbers are finer, and the mesh's own size counts.
Places findPlaces(Surface& surface, const SamePlace& same, double reach = 0);

} // namespace tegument::prep
