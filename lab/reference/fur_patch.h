#pragma once
// A flat patch of fur whose picture is known exactly: rays against cones. What shells show of it is held against that
// (docs/design/fur-layers.md). One strand stands in each cell of a unit lattice; lengths are in lattice spacings.

#include <cstdint>
#include <vector>

namespace tegument::reference {

struct FurPatch {
    double coat = 4;          // height of the coat, spacings
    double baseRadius = 0.38; // of a strand at its root
    double jitter = 0.3;      // largest distance of a root from its cell's centre along each axis
    double shortest = 0.6;    // lengths lie between this and 1, shares of the coat
    std::uint32_t seed = 1;
};

/// The strand of a cell.
struct FurStrand {
    double x = 0; // of its root
    double y = 0;
    double length = 1; // share of the coat
};
[[nodiscard]] FurStrand strandOf(const FurPatch& patch, int cellX, int cellY);

/// A ray that comes down to the patch: at height h (0 skin, 1 top of the coat) it is over (x + run * (1 - h), y). run = coat * tan(tilt).
struct FurRay {
    double x = 0;
    double y = 0;
    double run = 0;
};

inline constexpr double kNoHit = -1;

/// Height at which the ray first meets a strand, by the quadratic of each cone that it can reach; kNoHit where it meets the skin first.
[[nodiscard]] double exactHit(const FurPatch& patch, const FurRay& ray);

/// Up to where a point of the patch is covered, a share of the coat; below 0 beside all strands, where their cones go on: what a fur map of
/// the patch holds, so that nothing bends at their feet when it is interpolated.
[[nodiscard]] double heightOver(const FurPatch& patch, double x, double y);

struct FurView {
    double tilt = 0;    // radians from the patch's normal
    double pixel = 0.5; // side of a pixel seen from above, spacings
    int size = 48;      // pixels along each side
    int samples = 4;    // along each side of a pixel
};

struct FurError {
    double rms = 0;
    double bias = 0; // mean of picture - truth
};
[[nodiscard]] FurError furError(const std::vector<double>& picture, const std::vector<double>& truth);

} // namespace tegument::reference
