#pragma once
// Changes to a module's words that keep its code: bindings, locations, and the decorations that only reflection needs.

#include "host/compile/module.h"

#include <functional>

namespace tegument::spirv {

/// Overwrites the operand of every `OpDecorate id decoration value` for which `replace` gives a new value.
void replaceDecorations(std::vector<std::uint32_t>& words, spv::Decoration decoration,
                        const std::function<std::optional<std::uint32_t>(Id, std::uint32_t)>& replace);

/// Semantics and HLSL type names need extensions that a Vulkan 1.3 device need not have: removes both.
[[nodiscard]] std::vector<std::uint32_t> withoutReflectionDecorations(Words words);

} // namespace tegument::spirv
