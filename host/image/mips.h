#pragma once
// Mip levels, by this processor: devices filter eight bits each in their own way, and rounding once a level shortens normals.

#include "host/image/image.h"

#include <vector>

namespace tegument {

/// Half of each side, at least one texel: each the mean of what it covers. Sides of odd length are split, so that no texel is lost.
[[nodiscard]] Image halved(const Image& image);

/// What a level's means are taken of: the values, or the light that sRGB values encode. Alpha is never encoded.
enum class MeanOf { Values, Light };

/// The levels below the image, down to one texel. Every level is made from the one above before that is rounded to a texture's bits.
[[nodiscard]] std::vector<Image> mipLevels(const Image& image, MeanOf mean);

/// sRGB values to light, and back: all channels but alpha.
[[nodiscard]] Image decoded(Image image);
[[nodiscard]] Image encoded(Image image);

} // namespace tegument
