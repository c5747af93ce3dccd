#pragma once
// Input for tegument view from a file: a JSON list of steps.

#include "host/support/result.h"
#include "tools/view/reactions.h"

#include <filesystem>
#include <vector>

namespace tegument::app {

/// {"drag": [x, y]} (also "pan", "light": shares of the window's height, right and up), {"wheel": n}, {"key": "t"}, {"edit": FILE, "from":
/// A, "to": B}; "as" names the kind, "times" repeats the step. TG8049 for anything else. Files are named from the working folder.
[[nodiscard]] Result<std::vector<view::ReplayStep>> readReplay(const std::filesystem::path& file);

} // namespace tegument::app
