#pragma once
// A pyramid of quadratic B-splines from its definition: what its levels gather and how they answer to an edge, by carrying light through
// it. No variance, no two-scale relation is assumed.

#include "host/image/image.h"

#include <vector>

namespace tegument::reference {

/// A map reduced `level` times by 1 3 3 1 at once: the weights are three boxes of 2^level texels, convolved. Where they reach over the
/// map's edge, nothing is known: NaN.
[[nodiscard]] Image splineLevel(const Image& base, int level);

/// Light on one side of a straight edge: each texel of the base holds the share of it that is lit, as one does whose shadow is filtered
/// over its square. Reduced `level` times, brought back by linear interpolation at half the step, and read by linear interpolation: the
/// mean over all places that the edge may have between texels. At distances first + i * step, in texels of the base, on the lit side where
/// positive.
struct EdgeAnswer {
    double first = 0;
    double step = 0;
    std::vector<double> values;

    [[nodiscard]] double at(double distance) const;
};
[[nodiscard]] EdgeAnswer splineEdge(int level);

} // namespace tegument::reference
