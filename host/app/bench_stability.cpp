#include "host/app/bench_stability.h"

#include "host/app/output.h"
#include "host/bench/stability.h"
#include "host/support/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::app {

namespace {

Json rowJson(const bench::StabilityRow& row) {
    Json json{{"part", row.part}, {"module", row.module}, {"case", row.hardCase}, {"figure", row.figure}};
    json["value"] = std::isfinite(row.value) ? Json(row.value) : Json(nullptr);
    json["limit"] = row.limit ? Json(*row.limit) : Json(nullptr);
    json["not_finite"] = row.notFinite;
    json["pass"] = row.pass();
    json["cause"] = row.cause;
    json["why"] = row.why;
    return json;
}

std::string reportJson(const bench::StabilityReport& report, const gpu::DeviceInfo& device, const StabilityArguments& arguments) {
    Json json{{"device", device.name},       {"driver", device.driver}, {"compiler", compilerName(arguments.compiler)},
              {"version", TEGUMENT_VERSION}, {"size", arguments.size},  {"pass", report.pass()}};
    json["rows"] = Json::array();
    for (const bench::StabilityRow& row : report.rows)
        json["rows"].push_back(rowJson(row));
    json["notes"] = report.notes;
    return json.dump(2) + "\n";
}

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

Result<void> writeTo(const std::string& target, const std::string& text) {
    if (target.empty()) return {};
    if (target != "-") return writeFile(target, text);
    fmt::print("{}", text);
    return {};
}

Result<bool> measure(const StabilityArguments& arguments) {
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
    const gpu::DeviceInfo& info = device->info();
    if (const auto written = writeTo(arguments.json, reportJson(*report, info, arguments)); !written) return written.error();
    if (const auto written = writeTo(arguments.markdown, bench::stabilityMarkdown(*report)); !written) return written.error();
    if (arguments.json == "-" || arguments.markdown == "-") return report->pass();
    printReport(*report);
    fmt::print("\n{} of {} figures pass on {}, {}; maps and pictures of {} x {}\n",
               std::ranges::count_if(report->rows, &bench::StabilityRow::pass), report->rows.size(), info.name, info.driver, arguments.size,
               arguments.size);
    return report->pass();
}

} // namespace

int benchStability(const StabilityArguments& arguments) {
    const auto passed = measure(arguments);
    if (!passed) return fail(passed.error(), arguments.json == "-");
    return *passed ? 0 : static_cast<int>(Blame::Input);
}

} // namespace tegument::app
