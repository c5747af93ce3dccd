#pragma once
// The helpers in Python: plots by matplotlib, FLIP by flip-evaluator. Both are optional (docs/dependencies.md).

#include "lab/bench/bench.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tegument::bench {

/// What it printed. Debian's own python3 where there is one, since Debian's matplotlib belongs to it, else that of $PATH. TG8078 there is
/// no Python, or it lacks a package.
[[nodiscard]] Result<std::string> runHelper(const std::filesystem::path& script, const std::vector<std::string>& arguments);

/// FLIP by this script (flip.py); empty where its package is not installed.
[[nodiscard]] FlipMeter flipMeter(const std::filesystem::path& script);

} // namespace tegument::bench
