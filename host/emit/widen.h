#pragma once
// Pixel inputs as wide as the vertex outputs that they meet.

#include "host/emit/cross.h"

namespace tegument {

/// The words of a linked pixel shader in which every float input has as many components as `written` says: SPIR-V and Direct3D let a pixel
/// shader read fewer, GLSL does not.
[[nodiscard]] std::vector<std::uint32_t> withWholeInputs(const std::vector<std::uint32_t>& words, const Varyings& written);

} // namespace tegument
