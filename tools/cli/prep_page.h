#pragma once
// What `tegument prep` did to a mesh, as a report to look at.

#include "tools/cli/report_options.h"

namespace tegument::app {

/// Of what --report writes: cache misses, bytes, errors of levels, seconds.
[[nodiscard]] std::vector<report::Figure> prepFigures(const Json& run);

[[nodiscard]] report::Page prepPage(const Json& run);

} // namespace tegument::app
