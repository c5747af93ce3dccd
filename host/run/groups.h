#pragma once
// How many groups of threads a compute pass runs. Needs no GPU.

#include "host/run/prepare.h"

#include <array>
#include <cstdint>

namespace tegument::run {

/// Groups along x, y, z, by the pass's annotation: `Groups`, so many; `GroupCount`, as many as that parameter says; `Threads`, so many that
/// each texel of that target has a thread. All 0: nothing to do. TG4063: no annotation, or counts that are not whole numbers from 0 to
/// 65535.
[[nodiscard]] Result<std::array<std::uint32_t, 3>> groupsOf(const Effect& effect, const Prepared& prepared, const Pass& pass);

} // namespace tegument::run
