#pragma once
// What `tegument verify` found, as a report.

#include "lab/verify/verify.h"
#include "tools/cli/report_options.h"
#include "tools/report/report.h"

#include <optional>
#include <string>
#include <vector>

namespace tegument::app {

/// A module as it was verified, or why it could not be.
struct VerifiedModule {
    std::string module;
    std::string setting;
    ModuleReport report;
    std::optional<Error> error;

    [[nodiscard]] bool pass() const { return !error && report.pass(); }
};

struct PageHeader {
    std::string device;
    std::string driver;
    std::string compiler;
    std::string mesh;
    int mapSize = 0;
};

/// verify.json: {module, setting, metric, value, limit, pass} of every figure.
[[nodiscard]] Json metricsJson(const std::vector<VerifiedModule>& modules);
/// Each figure's size, from such a list; a hundredth of its limit counts as noise.
[[nodiscard]] std::vector<report::Figure> verifyFigures(const Json& metrics);

[[nodiscard]] report::Page verifyPage(const PageHeader& header, const std::vector<VerifiedModule>& modules);

} // namespace tegument::app
