#pragma once
// A flat patch of fur whose picture is known exactly: rays against cones. What shells show of it is held against that
// (docs/fur-accuracy.md). One strand stands in each cell of a unit lattice; lengths are in lattice spacings.

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

/// A ray that comes down to the patch: at height h (0 skin, 1 top of the coat) it is over (x + run * (1 - h), y). run = coat * tan(tilt).
struct FurRay {
    double x = 0;
    double y = 0;
    double run = 0;
};

inline constexpr double kNoHit = -1;

/// Height at which the ray first meets a strand, by the quadratic of each cone that it can reach; kNoHit where it meets the skin first.
[[nodiscard]] double exactHit(const FurPatch& patch, const FurRay& ray);

/// Height of the topmost of `layers` point-sampled shells, at (l - 1/2) / layers, on which the ray falls on a strand's section.
[[nodiscard]] double shellHit(const FurPatch& patch, const FurRay& ray, int layers);

/// The same with swept shells: between two neighbouring layers the segment of the ray is intersected with the cones in at most `cells`
/// cells along it, so that nothing between layers is lost while a segment is no longer than that.
[[nodiscard]] double sweptHit(const FurPatch& patch, const FurRay& ray, int layers, int cells);

struct FurView {
    double tilt = 0;    // radians from the patch's normal
    double pixel = 0.5; // side of a pixel seen from above, spacings
    int size = 48;      // pixels along each side
    int samples = 4;    // along each side of a pixel
};

/// Which of the above draws a picture.
struct FurMethod {
    enum class Kind { Exact, Shells, Swept } kind = Kind::Exact;
    int layers = 0;
    int cells = 0;
};

/// Brightness of each pixel, 0.05 skin, 0.15 to 1 strands from root to tip.
[[nodiscard]] std::vector<double> drawPatch(const FurPatch& patch, const FurView& view, const FurMethod& method);

struct FurError {
    double rms = 0;
    double bias = 0; // mean of picture - truth
};
[[nodiscard]] FurError furError(const std::vector<double>& picture, const std::vector<double>& truth);

} // namespace tegument::reference
