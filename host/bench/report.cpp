#include "host/bench/report.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <cmath>
#include <map>

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

Json headJson(const Row& row, const Machine& machine) {
    return {{"technique", row.contender.name()},
            {"setting", row.contender.setting},
            {"source", row.contender.source},
            {"scene", row.scene},
            {"mesh", row.mesh},
            {"resolution", {row.width, row.height}},
            {"map_size", row.mapSize},
            {"coverage", row.coverage},
            {"device", machine.device},
            {"driver", machine.driver},
            {"cpu", machine.cpu},
            {"compiler", machine.compiler},
            {"date", machine.date},
            {"version", machine.version}};
}

Json rowJson(const Row& row, const Machine& machine) {
    Json json = headJson(row, machine);
    if (row.failure) {
        json["failure"] = format(*row.failure);
        return json;
    }
    const Spread& ms = row.drawn.milliseconds;
    json["ms"] = {{"median", ms.median}, {"p5", ms.p5}, {"p95", ms.p95}, {"noise", ms.noise}};
    json["passes"] = passesJson(row.drawn);
    json["bytes"] = row.drawn.bytes;
    json["target_bytes"] = row.drawn.targetBytes;
    json["error"] = errorsJson(row.errors);
    json["own_error"] = row.own ? errorsJson(*row.own) : Json(nullptr);
    json["reference"] = {{"kind", row.wholeReference ? "brute force, every pixel" : "brute force, stratified pixels"},
                         {"id", row.referenceId},
                         {"pixels", row.referencePixels}};
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

/// A number of an object that may lack it.
std::string cell(const Json& object, const char* key, const char* pattern) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_number()) return "not measured";
    return fmt::format(fmt::runtime(pattern), object[key].get<double>());
}

std::string text(const Json& object, const char* key) {
    return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : std::string();
}

double number(const Json& object, const char* key) {
    return object.contains(key) && object[key].is_number() ? object[key].get<double>() : 0;
}

bool isRow(const Json& row) {
    return row.is_object() && row.contains("technique") && row.contains("resolution") && row["resolution"].is_array() &&
           row["resolution"].size() == 2 && row["resolution"][0].is_number() && row["resolution"][1].is_number();
}

constexpr const char* kMarkdownHeader =
    "| technique | setting | ms, median | p5 | p95 | MiB | rel L2 | p99 | bias | FLIP | rel L2, own definition "
    "|\n|---|---|---|---|---|---|---|---|---|---|---|\n";

/// What a table's rows have in common, as its title.
std::string title(const Json& row) {
    return fmt::format("{}, {} x {}, maps of {} x {}, {:.0f} % of the picture is skin; {}, driver {}, compiler {}, {}, version {}",
                       text(row, "scene"), row["resolution"][0].get<int>(), row["resolution"][1].get<int>(), number(row, "map_size"),
                       number(row, "map_size"), 100 * number(row, "coverage"), text(row, "device"), text(row, "driver"),
                       text(row, "compiler"), text(row, "date"), text(row, "version"));
}

std::string markdownRow(const Json& row) {
    if (row.contains("failure"))
        return fmt::format("| {} | {} | {} |\n", text(row, "technique"), text(row, "setting"), "could not be drawn");
    const Json none;
    const Json& ms = row.contains("ms") ? row["ms"] : none;
    const Json& error = row.contains("error") ? row["error"] : none;
    const Json& own = row.contains("own_error") ? row["own_error"] : none;
    return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", text(row, "technique"), text(row, "setting"),
                       cell(ms, "median", "{:.3f}"), cell(ms, "p5", "{:.3f}"), cell(ms, "p95", "{:.3f}"),
                       mebibytes(static_cast<std::uint64_t>(number(row, "target_bytes"))), cell(error, "rel_l2", "{:.4f}"),
                       cell(error, "p99", "{:.3f}"), cell(error, "bias", "{:+.4f}"), cell(error, "flip", "{:.4f}"),
                       own.is_object() ? cell(own, "rel_l2", "{:.4f}") : "the same");
}

} // namespace

std::string toJson(const std::vector<Row>& rows, const Machine& machine) {
    Json list = Json::array();
    for (const Row& row : rows)
        list.push_back(rowJson(row, machine));
    return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string toCsv(const std::vector<Row>& rows, const Machine& machine) {
    std::string csv =
        "technique,setting,scene,mesh,width,height,map_size,coverage,device,driver,ms_median,ms_p5,ms_p95,ms_noise,bytes,target_bytes,"
        "rel_l2,p99,p999,max_interior,bias,psnr,flip,own_rel_l2,reference_id,reference_pixels\n";
    for (const Row& row : rows) {
        if (row.failure) continue;
        const Spread& ms = row.drawn.milliseconds;
        const Errors& e = row.errors;
        csv += fmt::format(
            "{},{},{},{},{},{},{},{:.6g},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{},{},{}\n",
            quoted(row.contender.name()), quoted(row.contender.setting), quoted(row.scene), quoted(row.mesh), row.width, row.height,
            row.mapSize, row.coverage, quoted(machine.device), quoted(machine.driver), ms.median, ms.p5, ms.p95, ms.noise, row.drawn.bytes,
            row.drawn.targetBytes, e.relativeL2, e.p99, e.p999, e.largestInterior, e.bias, e.psnr,
            e.flip ? fmt::format("{:.6g}", *e.flip) : "", row.own ? fmt::format("{:.6g}", row.own->relativeL2) : "", row.referenceId,
            row.referencePixels);
    }
    return csv;
}

Table toTable(const std::vector<Row>& rows) {
    Table table{.header = {"technique", "setting", "scene", "maps", "ms", "p5", "p95", "MiB", "rel L2", "p99", "max", "bias", "PSNR",
                           "FLIP", "own"},
                .rows = {}};
    for (const Row& row : rows) {
        std::vector<std::string> cells = {row.contender.name(), row.contender.setting, row.scene, std::to_string(row.mapSize)};
        const Spread& ms = row.drawn.milliseconds;
        const Errors& e = row.errors;
        if (row.failure)
            cells.insert(cells.end(), {"failed", "", "", "", "", "", "", "", "", "", ""});
        else
            cells.insert(cells.end(),
                         {fmt::format("{:.3f}", ms.median), fmt::format("{:.3f}", ms.p5), fmt::format("{:.3f}", ms.p95),
                          mebibytes(row.drawn.targetBytes), fmt::format("{:.4f}", e.relativeL2), fmt::format("{:.3f}", e.p99),
                          fmt::format("{:.3f}", e.largestInterior), fmt::format("{:+.4f}", e.bias), fmt::format("{:.1f}", e.psnr),
                          optional(e.flip, "-"), row.own ? fmt::format("{:.4f}", row.own->relativeL2) : "-"});
        table.rows.push_back(std::move(cells));
    }
    return table;
}

Result<std::string> toMarkdown(const std::string& json, const std::string& nameForMessages) {
    const Json list = Json::parse(json, nullptr, false);
    if (!list.is_array())
        return inputError(8076, {.file = nameForMessages, .byte = {}}, "not a list of results", "give what tegument bench --json wrote");
    std::vector<std::string> titles;
    std::map<std::string, std::string> tables;
    for (const Json& row : list) {
        if (!isRow(row))
            return inputError(8076, {.file = nameForMessages, .byte = {}}, "an entry of the list is no result of a comparison",
                              "give what tegument bench --json wrote");
        const std::string name = title(row);
        if (!tables.contains(name)) titles.push_back(name);
        tables[name] += markdownRow(row);
    }
    std::string markdown;
    for (const std::string& name : titles)
        markdown += name + ".\n\n" + kMarkdownHeader + tables[name] + "\n";
    return markdown;
}

} // namespace tegument::bench
