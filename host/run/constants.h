#pragma once
// Lays parameter values out in a uniform block as the SPIR-V's reflection says.

#include "host/effect/model.h"
#include "host/run/values.h"
#include "host/spirv/compile.h"

#include <cstddef>
#include <span>
#include <vector>

namespace tegument::run {

/// Writes `value` (row order) at the member's offsets. Matrices: HLSL's column_major shows as RowMajor in the SPIR-V, its element (row,
/// column) lies at column * stride + 4 * row: the transpose of the row-vector matrix, as in a Direct3D 11 constant buffer. TG4019 when the
/// member and the parameter differ in shape.
[[nodiscard]] Result<void> pack(const BlockMember& member, const Parameter& parameter, const Numbers& value, std::span<std::byte> block);

} // namespace tegument::run
