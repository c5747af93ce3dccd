#pragma once
// Images to texels and back: 8-bit, half, float.

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

} // namespace tegument::run
