#pragma once
// Reflection of a SPIR-V module in the terms of HLSL.

#include "host/spirv/compile.h"

#include <cstdint>
#include <set>
#include <span>
#include <utility>

namespace tegument::spirv {

/// Numbers the descriptors in the order that compile.h promises ($Globals 0, constant buffers by name, then all else by name), inside the
/// words too, and reads blocks, resources and stage variables. The module is valid and still has its semantics. TG3003 for what SPIRV-Cross
/// cannot read, TG3006 for what a Reflection cannot express.
[[nodiscard]] Result<Reflection> reflect(std::vector<std::uint32_t>& words, ShaderStage stage, std::uint32_t set, const std::string& file);

/// Whether a vertex shader has the position among its outputs.
[[nodiscard]] bool writesPosition(std::span<const std::uint32_t> words);

/// Whether some look-up brings gradients of its own (tex2Dgrad, SampleGrad).
[[nodiscard]] bool readsByGradient(std::span<const std::uint32_t> words);

/// Sets and bindings of the pictures that some look-up compares with a depth (SampleCmp).
[[nodiscard]] std::set<std::pair<std::uint32_t, std::uint32_t>> comparedPictures(std::span<const std::uint32_t> words);

/// "normal" -> "NORMAL0".
[[nodiscard]] std::string canonicalSemantic(std::string_view written, std::uint32_t element = 0);

} // namespace tegument::spirv
