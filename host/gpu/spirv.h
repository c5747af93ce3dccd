#pragma once
// Keeps what is no module away from the driver, which is allowed to crash on it. Whoever compiles validates (host/spirv).
// A pixel shader may write colours that no target takes: Direct3D drops them. Vulkan does, too, and its validation layer warns of each.

#include "host/support/result.h"
#include "host/support/shader_stage.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tegument::gpu::detail {

/// The words are whole instructions of SPIR-V that declare this entry point for this stage: TG6020, TG6021.
[[nodiscard]] Result<void> checkShader(std::span<const std::uint32_t> words, const std::string& entry, ShaderStage stage,
                                       const std::string& pipeline);

/// The module with its outputs from location `targets` on as variables of its own. Empty where there is none, or one that is not merely
/// stored to.
[[nodiscard]] std::vector<std::uint32_t> withoutOutputsFrom(std::uint32_t targets, std::span<const std::uint32_t> words);

} // namespace tegument::gpu::detail
