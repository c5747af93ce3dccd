#pragma once
// Some texels of a texture, where all would take too long.

#include "host/gpu/gpu.h"

namespace tegument::gpu {

/// Texels of one mip level, from the left top.
struct TexelRect {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t width = 1;
    std::uint32_t height = 1;
};

/// As Device::readback gives all of them. TG6014: they are not all there.
[[nodiscard]] Result<std::vector<std::byte>> readbackPart(Texture& texture, const TexelRect& part, std::uint32_t mip = 0,
                                                          std::uint32_t layer = 0);

} // namespace tegument::gpu
