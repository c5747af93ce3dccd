#pragma once
// Images to texels and back: 8-bit, half, float.
// What the device has drawn, as a picture.

#include "host/gpu/part.h"
#include "host/image/image.h"
#include "host/support/layout.h"

#include <cstddef>
#include <span>
#include <vector>

namespace tegument::run {

/// What a file's image becomes on the GPU: 8 bits as sRGB (decoded on sampling) or plain; 16 bits; floats. Wider sRGB files are decoded
/// here.
[[nodiscard]] PixelFormat formatFor(const Image& image, bool srgb);

/// Rows of texels in a four-channel format or in a float format of the image's own channel count. Grey is spread to red, green and blue,
/// a missing alpha is 1. `decode`: sRGB to linear first.
[[nodiscard]] std::vector<std::byte> texels(const Image& image, PixelFormat format, bool decode);

/// Texels of a target as Device::readback gives them (depth as 32-bit floats).
[[nodiscard]] Image imageFrom(std::span<const std::byte> texels, int width, int height, PixelFormat format);

/// A level of the first face, or of another one: floats, halves and bytes as floats, depth as one channel.
[[nodiscard]] Result<Image> readBack(gpu::Device& device, gpu::Texture& texture, std::uint32_t mip = 0, std::uint32_t face = 0);
/// About so many of its rows, spread evenly, or all where it has fewer.
[[nodiscard]] Result<Image> readBackRows(gpu::Device& device, gpu::Texture& texture, int rows);
/// A picture of some of its texels.
[[nodiscard]] Result<Image> readBackPart(gpu::Texture& texture, const gpu::TexelRect& part, std::uint32_t mip = 0);

} // namespace tegument::run
