#pragma once
// What tegument prep says about a mesh, as JSON and for people.

#include "host/app/output.h"
#include "meshprep/prepare/prepare.h"

namespace tegument::app {

/// `output` is empty when nothing was written.
[[nodiscard]] Json reportJson(const prep::PrepReport& report, const std::string& input, const std::string& output);
void printReport(const prep::PrepReport& report);

} // namespace tegument::app
