#pragma once
// Which vertices are at one place.

#include "meshprep/prepare/surface.h"

namespace tegument::prep {

/// Exact (0.0 and -0.0 are equal) unless one of these is given.
struct SamePlace {
    double epsilon = 0;          // mm: at most this far from the first vertex of the place
    std::optional<int> decimals; // equal when printed with this many decimals, as the source document's programs did
};

/// Most decimals for which x * 10^n is exact in double precision for every float x, so that rounding it is what printf does.
inline constexpr int kMostDecimals = 12;

/// Fills `point`, and moves each vertex to the first one of its place. Gives how many vertices are at the place of an earlier one.
std::size_t findPlaces(Surface& surface, const SamePlace& same);

} // namespace tegument::prep
