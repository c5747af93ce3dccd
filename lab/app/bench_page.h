#pragma once
// What `tegument bench` measured, as a report.

#include "tools/cli/report_options.h"

#include <filesystem>

namespace tegument::app {

/// Time, error and memory of each row that was drawn, from the list that --json writes. Times of another device have another name: they
/// are compared with none of this one.
[[nodiscard]] std::vector<report::Figure> benchFigures(const Json& rows);

/// `pictures`: the folder of --pictures, whose files are shown where every pixel has a reference; empty: none.
[[nodiscard]] report::Page benchPage(const Json& rows, const std::filesystem::path& pictures);

/// The same of what `bench --stability --json` writes: every module's hard cases.
[[nodiscard]] std::vector<report::Figure> stabilityFigures(const Json& run);
[[nodiscard]] report::Page stabilityPage(const Json& run);

} // namespace tegument::app
