#include "tools/cli/report_options.h"

#include "host/support/file.h"
#include "tools/cli/command_line.h"

#include <fmt/format.h>

namespace tegument::app {

void addReportOptions(CLI::App& command, ReportOptions& options, const std::string& written) {
    command.add_option("--html", options.html, "Write a report to look at: one file of HTML, which needs no network");
    CLI::Option* against = command.add_option(
        "--against", options.against, fmt::format("An earlier run ({}): tell what got slower, larger or less accurate since", written));
    command.add_option("--threshold", options.threshold, "Per cent by which a figure must grow to count as worse, beyond its noise")
        ->check(CLI::Range(0.0, 1e6))
        ->needs(against)
        ->capture_default_str();
}

Result<Json> earlierRun(const ReportOptions& options, const FiguresOf& figuresOf) {
    if (const auto can = checkOutput(options.html, {".html", ".htm"}); !can) return can.error();
    if (options.against.empty()) return Json(nullptr);
    const auto text = readFile(options.against);
    if (!text) return text.error();
    Json json = Json::parse(*text, nullptr, false);
    if (json.is_discarded() || figuresOf(json).empty())
        return inputError(8091, {.file = options.against}, "this file holds no earlier run of this command",
                          "--against takes the JSON that the command itself wrote");
    return json;
}

Result<void> tellReport(const ReportOptions& options, const Json& earlier, const Json& run, const FiguresOf& figuresOf,
                        const std::function<report::Page()>& page) {
    const bool compared = !earlier.is_null();
    report::Changes changes;
    if (compared) {
        changes = report::compareRuns(figuresOf(earlier), figuresOf(run), options.threshold / 100);
        std::fflush(stdout); // the table before what follows it
        fmt::print(stderr, "{}", report::changesText(changes, options.against, options.threshold / 100));
    }
    if (options.html.empty()) return {};
    report::Page made = page();
    if (compared) made.sections.insert(made.sections.begin(), report::changesSection(changes, options.against, options.threshold / 100));
    if (const auto written = report::write(options.html, made); !written) return written;
    say("wrote " + options.html);
    return {};
}

Json valueAt(const Json& json, const char* place) {
    const Json::json_pointer pointer(place);
    return json.contains(pointer) ? json.at(pointer) : Json(nullptr);
}

std::optional<double> numberAt(const Json& json, const char* place) {
    const Json found = valueAt(json, place);
    return found.is_number() ? std::optional(found.get<double>()) : std::nullopt;
}

std::string textAt(const Json& json, const char* place) {
    const Json found = valueAt(json, place);
    return found.is_string() ? found.get<std::string>() : std::string();
}

} // namespace tegument::app
