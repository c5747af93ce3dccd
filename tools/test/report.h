#pragma once
// Results for other programs.

#include "tools/test/run.h"

#include <algorithm>
#include <string>

namespace tegument::testing {

/// JUnit's XML, as servers of continuous integration read it.
[[nodiscard]] std::string junit(const std::vector<FileResult>& results);

struct FileCoverage {
    std::map<int, std::uint64_t> lines;                // with statements, and how often each ran
    std::map<std::array<int, 3>, std::uint64_t> sides; // of branches: line, column, whether the condition did not hold
};
/// By source file.
using Coverage = std::map<std::string, FileCoverage>;
[[nodiscard]] Coverage coverageOf(const std::vector<FileResult>& results);
/// Of lines or sides those that ran.
[[nodiscard]] std::size_t ran(const auto& counts) {
    return static_cast<std::size_t>(std::ranges::count_if(counts, [](const auto& each) { return each.second > 0; }));
}
/// For genhtml, and for editors that mark lines.
[[nodiscard]] std::string lcov(const Coverage& coverage);

} // namespace tegument::testing
