#pragma once
// Runs what was prepared, frame after frame, and reads targets back.

#include "host/run/prepare.h"

#include <string>

namespace tegument::run {

/// TG4029 a target to dump that the technique does not use.
[[nodiscard]] Result<RunResult> execute(const RunInput& input, Prepared& prepared);

} // namespace tegument::run
