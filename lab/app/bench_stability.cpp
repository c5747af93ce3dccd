#include "lab/app/bench_stability.h"

#include "host/support/file.h"
#include "lab/app/bench_page.h"
#include "lab/stability/stability.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::app {

namespace {

void printReport(const bench::StabilityReport& report) {
    std::vector<std::vector<std::string>> rows;
    for (const bench::StabilityRow& row : report.rows)
        rows.push_back({row.module, row.hardCase, row.figure, fmt::format("{:.2g}", row.value),
                        row.limit ? fmt::format("{:.2g}", *row.limit) : "-", std::to_string(row.notFinite), row.pass() ? "" : "FAIL",
                        row.cause});
    fmt::print("{}", table({"module", "hard case", "figure", "value", "limit", "not finite", "", "caused by"}, rows));
    for (const std::string& note : report.notes)
        fmt::print("{}\n", note);
}

Result<bool> measure(const StabilityArguments& arguments) {
    const auto earlier = earlierRun(arguments.report, stabilityFigures);
    if (!earlier) return earlier.error();
    auto device = gpu::Device::create({.validation = false, .prefer = arguments.device});
    if (!device) return device.error();
    Progress progress;
    const auto report = bench::measureStability(*device, {.effects = arguments.effects,
                                                          .compiler = arguments.compiler,
                                                          .size = arguments.size,
                                                          .parts = arguments.parts,
                                                          .modules = arguments.modules,
                                                          .other = nullptr,
                                                          .say = [&](const std::string& line) { progress.say(line); }});
    progress.clear();
    if (!report) return report.error();
    const std::string json = bench::stabilityJson(*report);
    const Json run = Json::parse(json);
    const auto told = tellReport(arguments.report, *earlier, run, stabilityFigures, [&] { return stabilityPage(run); });
    if (!told) return told.error();
    if (arguments.json == "-") {
        fmt::print("{}", json);
        return report->pass();
    }
    if (!arguments.json.empty())
        if (const auto written = writeFile(arguments.json, json); !written) return written.error();
    printReport(*report);
    fmt::print("\n{} of {} figures pass on {}, {}; maps of {} x {}\n", std::ranges::count_if(report->rows, &bench::StabilityRow::pass),
               report->rows.size(), report->device, report->driver, report->size, report->size);
    return report->pass();
}

} // namespace

std::optional<std::string> stabilityTables(const std::string& json) {
    const auto report = bench::stabilityFromJson(json);
    return report ? std::optional(bench::stabilityMarkdown(*report)) : std::nullopt;
}

int benchStability(const StabilityArguments& arguments) {
    const auto passed = measure(arguments);
    if (!passed) return fail(passed.error(), arguments.json == "-");
    return *passed ? 0 : static_cast<int>(Blame::Input);
}

} // namespace tegument::app
