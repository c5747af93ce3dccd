#pragma once
// What a shader of model 3 uses, read from Microsoft's disassembly.

#include "tools/direct3d/microsoft.h"

#include <optional>
#include <string_view>

namespace tegument {

/// Nothing when `listing` is no disassembly of vs_3_0 or ps_3_0.
[[nodiscard]] std::optional<Sm3Usage> readSm3Listing(std::string_view listing);

} // namespace tegument
