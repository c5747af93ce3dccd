#pragma once
// What `tegument check` found, as a report.

#include "tools/cli/report_options.h"

namespace tegument::app {

/// Of what `check --json` writes: what each pass takes of shader model 3, and 1 for each target that failed, else 0.
[[nodiscard]] std::vector<report::Figure> checkFigures(const Json& run);

[[nodiscard]] report::Page checkPage(const Json& run);

} // namespace tegument::app
