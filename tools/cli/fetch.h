#pragma once
// Data that the project does not hold, fetched once by meshprep/fetch.py.

#include "host/support/result.h"

#include <filesystem>
#include <string>

namespace tegument::app {

/// "human" or "bunny" into this folder, if it is not there yet. TG8025, the machine's: no Python, no network, no package; the message says
/// what to do.
[[nodiscard]] Result<void> fetch(const std::string& what, const std::filesystem::path& folder);

} // namespace tegument::app
