#pragma once
// How long a strand may be before layers of the coat cross: where the surface is concave, normals meet at the centre of curvature; where
// another sheet stands opposite, tips meet half-way.

#include "meshprep/fur/roots/fur_surface.h"

namespace tegument {

/// In the surface's unit space.
struct LengthLimits {
    float curvature = 0; // of the concave side, 1 / radius; 0 where the surface is flat or convex
    float opposite = 0;  // distance to the next surface along the normal; infinite if there is none
};

/// Of concave curvature, the share of its radius that a strand may have.
inline constexpr float kShareOfCurvature = 0.8F;

/// For each root. The curvature is that of the normals of all roots within `reach` that look to the same side: what strands, at their
/// distance from each other, can show of it.
[[nodiscard]] std::vector<LengthLimits> lengthLimits(const FurSurface& surface, const std::vector<SurfacePoint>& roots, float reach,
                                                     unsigned threads);

} // namespace tegument
