#pragma once
// Reflection of a SPIR-V module in the terms of HLSL.

#include "host/compile/compile.h"
#include "host/compile/module.h"

namespace tegument::spirv {

/// The order that compile.h promises: $Globals 0, constant buffers by name, then all else by name.
void assignDescriptors(std::vector<std::uint32_t>& words, std::uint32_t set);

/// Reads blocks, resources and stage variables; the semantics must still be there. TG3006 for what a Reflection cannot express.
[[nodiscard]] Result<Reflection> reflect(const Module& module, Stage stage, const std::string& file);

/// "normal" -> "NORMAL0".
[[nodiscard]] std::string canonicalSemantic(std::string_view written, std::uint32_t element = 0);

} // namespace tegument::spirv
