#pragma once
// Inside lab/verify: an edge of light on a plane, drawn by the effects.

#include "lab/reference/edge_study.h"
#include "lab/verify/work.h"

namespace tegument::verify {

/// The six maps of Convolution.fx in the middle row, divided by the light far inside. The edge lies `phase` texels before a texel's centre;
/// `texel` mm.
struct DrawnEdge {
    double texel = 0;
    double phase = 0;
    std::vector<std::vector<double>> maps; // six rows

    /// Weighted by the profile and read back linearly between texels.
    [[nodiscard]] reference::EdgeResponse response() const;
    /// Variance of what has blurred one map, mm^2, its texels' own square included. For phase 1/2, where the edge lies between two texels
    /// and the unblurred map does not show that square.
    [[nodiscard]] double variance(std::size_t map) const;
};

[[nodiscard]] Result<DrawnEdge> drawEdge(const Context& context, double texel, double phase);

} // namespace tegument::verify
