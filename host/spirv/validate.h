#pragma once
// SPIR-V validation and stripping by SPIRV-Tools, in process.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tegument::spirv {

/// Empty when the module is valid for Vulkan 1.3; otherwise what the validator says.
[[nodiscard]] std::string validate(std::span<const std::uint32_t> words);

/// Semantics and HLSL type names need extensions that a Vulkan 1.3 device need not have: a valid module without both. Empty when it cannot
/// be read.
[[nodiscard]] std::vector<std::uint32_t> withoutReflectionDecorations(std::span<const std::uint32_t> words);

/// "SPIRV-Tools v2023.1 ..."
[[nodiscard]] std::string validatorName();

} // namespace tegument::spirv
