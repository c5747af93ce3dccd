#pragma once
// SPIR-V validation by SPIRV-Tools, in process.

#include <cstdint>
#include <span>
#include <string>

namespace tegument::spirv {

/// Empty when the module is valid for Vulkan 1.1; otherwise what the validator says.
[[nodiscard]] std::string validate(std::span<const std::uint32_t> words);

/// "SPIRV-Tools v2023.1 ..."
[[nodiscard]] std::string validatorName();

} // namespace tegument::spirv
