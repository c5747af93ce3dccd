#pragma once
// Formats as Vulkan names them.

#include "host/gpu/gpu.h"

#include <vulkan/vulkan.hpp>

namespace tegument::gpu::detail {

[[nodiscard]] vk::Format vulkanFormat(Format format);
/// Colour, depth, or depth and stencil.
[[nodiscard]] vk::ImageAspectFlags aspects(Format format);
/// Bytes of one pixel of the aspect that uploads and readbacks copy: colour or depth.
[[nodiscard]] std::uint32_t copiedBytesPerPixel(Format format);
/// Copied depth texels as 32-bit floats.
[[nodiscard]] std::vector<std::byte> depthAsFloats(Format format, std::span<const std::byte> texels);

} // namespace tegument::gpu::detail
