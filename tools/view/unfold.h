#pragma once
// A cube map as a flat picture of its six faces.

#include "host/gpu/gpu.h"

namespace tegument::view {

/// Above +Y, below -Y, between them -X, +Z, +X, -Z, as a box that stands open; every level that the cube has, of faces with at most 512
/// texels along each side.
[[nodiscard]] Result<gpu::Texture> unfolded(gpu::Device& device, gpu::Texture& cube);

} // namespace tegument::view
