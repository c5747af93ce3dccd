#pragma once
// Values that were set and make no difference to the technique that is drawn.

#include "host/run/run.h"

#include <string>
#include <vector>

namespace tegument::app {

/// TG8029 for each `NAME=VALUE` of which the frame has read nothing; the hint names the techniques that do.
[[nodiscard]] std::vector<Diagnostic> unreadValues(const std::vector<std::string>& sets, const Effect& effect, const RunResult& drawn);

} // namespace tegument::app
