#pragma once
// What tegument prep says about a mesh, as JSON and for people.

#include "meshprep/prepare/prepare.h"
#include "tools/cli/output.h"

namespace tegument::app {

/// `output` is empty when nothing was written.
[[nodiscard]] Json reportJson(const prep::PrepReport& report, const std::string& input, const std::string& output);
void printReport(const prep::PrepReport& report);

} // namespace tegument::app
