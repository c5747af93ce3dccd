#pragma once
// tegument bench --stability: every module over its hard cases.

#include "host/spirv/compile.h"
#include "tools/cli/report_options.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tegument::app {

struct StabilityArguments {
    std::filesystem::path effects;
    std::vector<std::string> parts;   // empty: all
    std::vector<std::string> modules; // likewise
    int size = 128;                   // texels a side of the maps, pixels a side of the pictures
    Compiler compiler = Compiler::Dxc;
    std::string device;
    std::string json; // file, "-": standard output, empty: none
    ReportOptions report;
};

/// The exit code: 1 where something is not finite or beyond its limit.
int benchStability(const StabilityArguments& arguments);

/// The tables of such a report's JSON as Markdown; none when it is something else.
[[nodiscard]] std::optional<std::string> stabilityTables(const std::string& json);

} // namespace tegument::app
