#pragma once
// What the device has drawn, as a picture.

#include "host/gpu/gpu.h"
#include "host/image/image.h"

namespace tegument::run {

/// The first level of the first face: floats, halves and bytes as floats, depth as one channel.
[[nodiscard]] Result<Image> readBack(gpu::Device& device, gpu::Texture& texture);

} // namespace tegument::run
