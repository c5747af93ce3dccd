#pragma once
// What this program is made of and finds here: for reports of faults.

#include <string>

namespace tegument::app {

/// The version alone, or with compilers, libraries and the device, one to a line.
[[nodiscard]] std::string versionText(bool verbose);

} // namespace tegument::app
