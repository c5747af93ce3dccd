#pragma once
// D3DReflect's numbers in our terms.

#include "tools/direct3d/microsoft.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace tegument {

/// What microsoft/reflection.cpp wrote. Nothing: not a reflection.
[[nodiscard]] std::optional<Sm5Reflection> readSm5Reflection(const nlohmann::json& json);

} // namespace tegument
