#pragma once
// Results for other programs.

#include "tools/test/run.h"

#include <string>

namespace tegument::testing {

/// JUnit's XML, as servers of continuous integration read it.
[[nodiscard]] std::string junit(const std::vector<FileResult>& results);

/// Of a source file its lines with statements, and how often each ran.
using Coverage = std::map<std::string, std::map<int, std::uint64_t>>;
[[nodiscard]] Coverage coverageOf(const std::vector<FileResult>& results);
/// For genhtml, and for editors that mark lines.
[[nodiscard]] std::string lcov(const Coverage& coverage);

} // namespace tegument::testing
