#pragma once
// --html, --against and --threshold: what verify, bench, check and prep share of their reports.

#include "tools/cli/output.h"
#include "tools/report/against.h"

#include <functional>
#include <optional>

namespace CLI {
class App;
}

namespace tegument::app {

struct ReportOptions {
    std::string html;
    std::string against;
    double threshold = 5; // per cent
};

/// `written`: what writes the file that --against reads, "verify -o" for example.
void addReportOptions(CLI::App& command, ReportOptions& options, const std::string& written);

/// The figures of a run, from what the command writes as JSON; none where it is something else.
using FiguresOf = std::function<std::vector<report::Figure>(const Json& run)>;

/// Asked before the work: TG5002 the report cannot be written, TG8024 it is no .html; TG8091 the earlier run is none of this command. Null
/// without --against.
[[nodiscard]] Result<Json> earlierRun(const ReportOptions& options, const FiguresOf& figuresOf);

/// Compares with the earlier run, tells it on standard error, and writes the page with it, each where it is asked for.
[[nodiscard]] Result<void> tellReport(const ReportOptions& options, const Json& earlier, const Json& run, const FiguresOf& figuresOf,
                                      const std::function<report::Page()>& page);

/// What stands at this place of any JSON ("/ms/median"); empty, or none, where it does not.
[[nodiscard]] std::optional<double> numberAt(const Json& json, const char* place);
[[nodiscard]] std::string textAt(const Json& json, const char* place);
/// Null where there is none.
[[nodiscard]] Json valueAt(const Json& json, const char* place);

} // namespace tegument::app
