#pragma once
// What the device has drawn, as a picture.

#include "host/gpu/part.h"
#include "host/image/image.h"

namespace tegument::run {

/// A level of the first face, or of another one: floats, halves and bytes as floats, depth as one channel.
[[nodiscard]] Result<Image> readBack(gpu::Device& device, gpu::Texture& texture, std::uint32_t mip = 0, std::uint32_t face = 0);
/// About so many of its rows, spread evenly, or all where it has fewer.
[[nodiscard]] Result<Image> readBackRows(gpu::Device& device, gpu::Texture& texture, int rows);
/// A picture of some of its texels.
[[nodiscard]] Result<Image> readBackPart(gpu::Texture& texture, const gpu::TexelRect& part, std::uint32_t mip = 0);

} // namespace tegument::run
