#include "lab/bench/report.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace tegument::bench {

namespace {

using Json = nlohmann::ordered_json;

Json numberOrNull(std::optional<double> value) {
    return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json errorsJson(const Errors& errors) {
    return {{"rel_l2", numberOrNull(errors.relativeL2)}, {"p99", numberOrNull(errors.p99)},
            {"p999", numberOrNull(errors.p999)},         {"max_interior", numberOrNull(errors.largestInterior)},
            {"bias", numberOrNull(errors.bias)},         {"psnr", numberOrNull(errors.psnr)},
            {"flip", numberOrNull(errors.flip)}};
}

Json passesJson(const Drawn& drawn) {
    Json passes = Json::array();
    for (const PassTime& pass : drawn.passes)
        passes.push_back({{"name", pass.name}, {"ms", pass.milliseconds}});
    return passes;
}

Json countsJson(const Traffic& traffic) {
    return {{"calls", traffic.calls}, {"fetches", traffic.fetches}, {"bytes_read", traffic.read}, {"bytes_written", traffic.written}};
}

Traffic sumOf(const std::vector<Traffic>& passes) {
    Traffic sum;
    for (const Traffic& pass : passes) {
        sum.calls += pass.calls;
        sum.fetches += pass.fetches;
        sum.read += pass.read;
        sum.written += pass.written;
    }
    return sum;
}

/// Null where nothing was counted.
Json trafficJson(const std::vector<Traffic>& passes) {
    if (passes.empty()) return nullptr;
    Json json = countsJson(sumOf(passes));
    json["passes"] = Json::array();
    for (const Traffic& pass : passes) {
        Json one{{"name", pass.pass}};
        one.update(countsJson(pass));
        json["passes"].push_back(std::move(one));
    }
    return json;
}

Json machineJson(const Machine& machine) {
    return {{"device", machine.device},     {"driver", machine.driver}, {"cpu", machine.cpu},
            {"compiler", machine.compiler}, {"date", machine.date},     {"version", machine.version}};
}

Json headJson(const Row& row, const Machine& machine) {
    Json json{{"technique", row.contender.name()},
              {"setting", row.contender.setting},
              {"source", row.contender.source},
              {"scene", row.scene},
              {"mesh", row.mesh},
              {"resolution", {row.width, row.height}},
              {"map_size", row.mapSize},
              {"shadow_size", row.shadowSize},
              {"coverage", row.coverage}};
    json.update(machineJson(machine));
    return json;
}

Json rowJson(const Row& row, const Machine& machine) {
    Json json = headJson(row, machine);
    if (row.failure) {
        json["failure"] = format(*row.failure);
        return json;
    }
    const Spread& ms = row.drawn.milliseconds;
    json["ms"] = {{"median", ms.median}, {"p5", ms.p5}, {"p95", ms.p95}, {"noise", ms.noise}};
    const Spread& gross = row.drawn.gross;
    json["ms_gross"] = {{"median", gross.median}, {"p5", gross.p5}, {"p95", gross.p95}, {"noise", gross.noise}};
    json["passes"] = passesJson(row.drawn);
    json["bytes"] = row.drawn.bytes;
    json["target_bytes"] = row.drawn.targetBytes;
    json["counts"] = trafficJson(row.drawn.traffic);
    json["error"] = errorsJson(row.errors);
    json["own_error"] = row.own ? errorsJson(*row.own) : Json(nullptr);
    json["own_definition"] = row.own                                      ? Json(row.contender.ownDefinition())
                             : row.contender.claim == Claim::SixGaussians ? Json("the truth")
                                                                          : Json(nullptr);
    json["reference"] = {{"kind", row.wholeReference ? "brute force, every pixel" : "brute force, stratified pixels"},
                         {"id", row.referenceId},
                         {"pixels", row.referencePixels},
                         {"samples", row.samples}};
    return json;
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char letter : text)
        result += letter == '"' ? std::string("\"\"") : std::string(1, letter);
    return result + '"';
}

std::string mebibytes(std::uint64_t bytes) {
    return fmt::format("{:.1f}", static_cast<double>(bytes) / (1 << 20));
}

std::string optional(std::optional<double> value, const char* absent) {
    return value ? fmt::format("{:.4f}", *value) : absent;
}

std::string dumped(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace

std::string toJson(const std::vector<Row>& rows, const Machine& machine) {
    Json list = Json::array();
    for (const Row& row : rows)
        list.push_back(rowJson(row, machine));
    return dumped(list);
}

std::string toCsv(const std::vector<Row>& rows, const Machine& machine) {
    std::string csv = "technique,setting,scene,mesh,width,height,map_size,shadow_size,coverage,device,driver,ms_median,ms_p5,ms_p95,ms_"
                      "noise,ms_gross,bytes,target_bytes,"
                      "rel_l2,p99,p999,max_interior,bias,psnr,flip,own_rel_l2,reference_id,reference_pixels\n";
    for (const Row& row : rows) {
        if (row.failure) continue;
        const Spread& ms = row.drawn.milliseconds;
        const Errors& e = row.errors;
        csv += fmt::format("{},{},{},{},{},{},{},{},{:.6g},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{},", quoted(row.contender.name()),
                           quoted(row.contender.setting), quoted(row.scene), quoted(row.mesh), row.width, row.height, row.mapSize,
                           row.shadowSize, row.coverage, quoted(machine.device), quoted(machine.driver), ms.median, ms.p5, ms.p95, ms.noise,
                           row.drawn.gross.median, row.drawn.bytes, row.drawn.targetBytes);
        csv += fmt::format("{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{},{},{}\n", e.relativeL2, e.p99, e.p999, e.largestInterior,
                           e.bias, e.psnr, e.flip ? fmt::format("{:.6g}", *e.flip) : "",
                           row.own ? fmt::format("{:.6g}", row.own->relativeL2) : "", row.referenceId, row.referencePixels);
    }
    return csv;
}

Table toTable(const std::vector<Row>& rows) {
    Table table{.header = {"technique", "setting", "scene", "maps", "shadow", "ms", "gross", "p5", "p95", "MiB", "rel L2", "p99", "max",
                           "bias", "PSNR", "FLIP", "own"}};
    const bool counted = std::ranges::any_of(rows, [](const Row& row) { return !row.drawn.traffic.empty(); });
    if (counted) table.header.insert(table.header.end(), {"Mfetch", "MiB read", "written"});
    for (const Row& row : rows) {
        std::vector<std::string> cells = {row.contender.name(), row.contender.setting, row.scene, std::to_string(row.mapSize),
                                          std::to_string(row.shadowSize)};
        const Spread& ms = row.drawn.milliseconds;
        const Errors& e = row.errors;
        if (row.failure)
            cells.insert(cells.end(), {"failed", "", "", "", "", "", "", "", "", "", "", ""});
        else
            cells.insert(cells.end(),
                         {fmt::format("{:.3f}", ms.median), fmt::format("{:.3f}", row.drawn.gross.median), fmt::format("{:.3f}", ms.p5),
                          fmt::format("{:.3f}", ms.p95), mebibytes(row.drawn.targetBytes), fmt::format("{:.4f}", e.relativeL2),
                          fmt::format("{:.3f}", e.p99), fmt::format("{:.3f}", e.largestInterior), fmt::format("{:+.4f}", e.bias),
                          fmt::format("{:.1f}", e.psnr), optional(e.flip, "-"),
                          row.own ? fmt::format("{:.4f}", row.own->relativeL2) : "-"});
        if (counted && !row.failure) {
            const Traffic sum = sumOf(row.drawn.traffic);
            cells.insert(cells.end(),
                         {fmt::format("{:.1f}", static_cast<double>(sum.fetches) / 1e6), mebibytes(sum.read), mebibytes(sum.written)});
        }
        cells.resize(table.header.size());
        table.rows.push_back(std::move(cells));
    }
    return table;
}

std::string toJson(const std::vector<Growth>& growth, const Machine& machine) {
    Json series = Json::array();
    for (const Growth& one : growth)
        series.push_back({{"quantity", one.quantity},
                          {"what", one.what},
                          {"x", one.x},
                          {"ms", one.milliseconds},
                          {"exponent", one.law.exponent},
                          {"factor", one.law.factor},
                          {"worst", one.law.worst},
                          {"fixed_ms", one.parts.fixed},
                          {"ms_per_unit", one.parts.slope},
                          {"affine_worst", one.parts.worst}});
    return dumped({{"machine", machineJson(machine)}, {"series", series}});
}

std::string toJson(const std::vector<AblationRow>& rows, const Machine& machine, const std::string& scene) {
    Json list = Json::array();
    for (const AblationRow& row : rows)
        list.push_back({{"group", row.group},
                        {"what", row.what},
                        {"ms", row.milliseconds},
                        {"noise", row.noise},
                        {"change", row.change},
                        {"rel_l2", numberOrNull(row.relativeL2)}});
    return dumped({{"machine", machineJson(machine)}, {"scene", scene}, {"ablation", list}});
}

std::string toJson(const std::vector<MotionRow>& rows, const Machine& machine, const std::string& scene) {
    Json list = Json::array();
    for (const MotionRow& row : rows)
        list.push_back({{"motion", row.motion},
                        {"technique", row.contender.name()},
                        {"setting", row.contender.setting},
                        {"rel_l2", numberOrNull(row.error)},
                        {"flicker", numberOrNull(row.flicker)},
                        {"largest", numberOrNull(row.largest)},
                        {"light", numberOrNull(row.light)}});
    return dumped({{"machine", machineJson(machine)}, {"scene", scene}, {"motion", list}});
}

Table toTable(const std::vector<MotionRow>& rows) {
    Table table{.header = {"motion", "technique", "setting", "rel L2", "flicker", "largest", "light"}};
    for (const MotionRow& row : rows)
        table.rows.push_back({row.motion, row.contender.name(), row.contender.setting, fmt::format("{:.4f}", row.error),
                              fmt::format("{:.4f}", row.flicker), fmt::format("{:.4f}", row.largest), fmt::format("{:.4f}", row.light)});
    return table;
}

Table toTable(const std::vector<Growth>& growth) {
    Table table{.header = {"time of", "grows with", "sizes", "ms", "exponent", "fixed, ms", "off"}};
    for (const Growth& one : growth) {
        std::vector<std::string> ms;
        for (const double milliseconds : one.milliseconds)
            ms.push_back(fmt::format("{:.3f}", milliseconds));
        table.rows.push_back({one.what, one.quantity, fmt::format("{:.0f}", fmt::join(one.x, ", ")), fmt::format("{}", fmt::join(ms, ", ")),
                              fmt::format("{:.2f}", one.law.exponent), fmt::format("{:.3f}", one.parts.fixed),
                              fmt::format("{:.0f} %", 100 * one.parts.worst)});
    }
    return table;
}

Table toTable(const std::vector<AblationRow>& rows) {
    Table table{.header = {"what", "ms", "change", "noise", "rel L2"}};
    std::string group;
    for (const AblationRow& row : rows) {
        if (row.group != group) table.rows.push_back({row.group, "", "", "", ""});
        group = row.group;
        table.rows.push_back({"  " + row.what, fmt::format("{:.3f}", row.milliseconds), fmt::format("{:+.3f}", row.change),
                              fmt::format("{:.3f}", row.noise), optional(row.relativeL2, "the same")});
    }
    return table;
}

} // namespace tegument::bench
