#pragma once
// A pixel shader may write colours that no target takes: Direct3D drops them. Vulkan does, too, and its validation layer warns of each.

#include <cstdint>
#include <span>
#include <vector>

namespace tegument::gpu::detail {

/// The module with its outputs from location `targets` on as variables of its own. Empty where there is none, or one that is not merely
/// stored to.
[[nodiscard]] std::vector<std::uint32_t> withoutOutputsFrom(std::uint32_t targets, std::span<const std::uint32_t> words);

} // namespace tegument::gpu::detail
