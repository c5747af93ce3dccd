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
/// Vulkan's flags, each of which has its number of samples as value: "1, 4".
[[nodiscard]] std::string listedSamples(std::uint32_t flags);

} // namespace tegument::gpu::detail
