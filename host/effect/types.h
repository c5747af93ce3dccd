#pragma once
// The names of HLSL's and the effect format's types.

#include "host/effect/model.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tegument {

/// The type of that name without template arguments or array; nullopt for names of structures and unknown ones.
[[nodiscard]] std::optional<Type> builtInType(std::string_view name);

/// Sampler types: 1, 2, 3, 6 (cube) when the name says what it samples, else 0.
[[nodiscard]] int samplerDimension(std::string_view name);

/// Direct3D 9 sampler types start with other defaults than SamplerState.
[[nodiscard]] bool isDirect3D9Sampler(std::string_view name);

/// Names to suggest for a misspelt type.
[[nodiscard]] std::span<const std::string> commonTypeNames();

} // namespace tegument
