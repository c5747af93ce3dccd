#pragma once
// The kernel size map of Gosselin's technique: how far light is spread at each point of the skin, painted by region.

#include "meshprep/human/brows.h"
#include "meshprep/human/face.h"

namespace tegument {

/// The largest value: 1 marks a texel without skin in the irradiance map (docs/design/skin.md).
inline constexpr float kLargestKernelSize = 0.99f;

/// Share of the technique's radius, 0 to kLargestKernelSize. Eyes and base are 0: nothing scatters there. Borders of regions are as sharp
/// as the masks; the map is softened as a whole.
[[nodiscard]] float kernelSize(const SurfacePoint& point, const Face& face, const Brows& brows);

/// The whole map, one channel, softened over four texels, which the gutters between charts allow for from 512 texels upwards.
[[nodiscard]] Image bakeKernelSize(const HeadSurface& head, int size, const Face& face, const Brows& brows);

} // namespace tegument
