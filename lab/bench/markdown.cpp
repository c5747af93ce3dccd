#include "lab/bench/report.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <map>

namespace tegument::bench {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFileHint = "give what tegument bench --json wrote";

std::string mebibytes(double bytes) {
    return fmt::format("{:.1f}", bytes / (1 << 20));
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
                       mebibytes(number(row, "target_bytes")), cell(error, "rel_l2", "{:.4f}"), cell(error, "p99", "{:.3f}"),
                       cell(error, "bias", "{:+.4f}"), cell(error, "flip", "{:.4f}"),
                       own.is_object()                       ? cell(own, "rel_l2", "{:.4f}")
                       : text(row, "own_definition").empty() ? "none"
                                                             : "the same");
}

/// Of a list with several scenes: relative L2 of each technique on each of them.
std::string scenesMarkdown(const Json& list) {
    std::vector<std::string> scenes;
    std::vector<std::string> contenders;
    std::map<std::pair<std::string, std::string>, std::string> cells;
    for (const Json& row : list) {
        const std::string scene = fmt::format("{}, {}", text(row, "scene"), number(row, "map_size"));
        const std::string contender = text(row, "technique") + " | " + text(row, "setting");
        if (std::ranges::find(scenes, scene) == scenes.end()) scenes.push_back(scene);
        if (std::ranges::find(contenders, contender) == contenders.end()) contenders.push_back(contender);
        cells[{contender, scene}] = row.contains("error") ? cell(row["error"], "rel_l2", "{:.4f}") : "not measured";
    }
    if (scenes.size() < 2) return {};
    std::string markdown = "Relative L2 by scene and side of the maps.\n\n| technique | setting |";
    for (const std::string& scene : scenes)
        markdown += fmt::format(" {} |", scene);
    markdown += "\n|---|---|";
    for (std::size_t i = 0; i < scenes.size(); ++i)
        markdown += "---|";
    for (const std::string& contender : contenders) {
        markdown += fmt::format("\n| {} |", contender);
        for (const std::string& scene : scenes)
            markdown += fmt::format(" {} |", cells[{contender, scene}]);
    }
    return markdown + "\n";
}

Result<std::string> resultsMarkdown(const Json& list, const std::string& file) {
    std::vector<std::string> titles;
    std::map<std::string, std::string> tables;
    for (const Json& row : list) {
        if (!isRow(row)) return inputError(8076, {.file = file}, "an entry of the list is no result of a comparison", kFileHint);
        const std::string name = title(row);
        if (!tables.contains(name)) titles.push_back(name);
        tables[name] += markdownRow(row);
    }
    std::string markdown;
    for (const std::string& name : titles)
        markdown += name + ".\n\n" + kMarkdownHeader + tables[name] + "\n";
    return markdown + scenesMarkdown(list);
}

std::string machineLine(const Json& json) {
    const Json& machine = json["machine"];
    return fmt::format("{}, driver {}, compiler {}, {}, version {}.\n\n", text(machine, "device"), text(machine, "driver"),
                       text(machine, "compiler"), text(machine, "date"), text(machine, "version"));
}

std::string growthMarkdown(const Json& json) {
    std::string markdown =
        machineLine(json) + "| time of | grows with | at | ms | exponent | fixed cost, ms | off by |\n|---|---|---|---|---|---|---|\n";
    for (const Json& one : json["series"]) {
        std::string sizes;
        std::string times;
        for (const Json& x : one["x"])
            sizes += fmt::format("{}{:.0f}", sizes.empty() ? "" : ", ", x.get<double>());
        for (const Json& ms : one["ms"])
            times += fmt::format("{}{:.3f}", times.empty() ? "" : ", ", ms.get<double>());
        markdown += fmt::format("| {} | {} | {} | {} | {} | {} | {:.0f} % |\n", text(one, "what"), text(one, "quantity"), sizes, times,
                                cell(one, "exponent", "{:.2f}"), cell(one, "fixed_ms", "{:.3f}"), 100 * number(one, "affine_worst"));
    }
    return markdown;
}

std::string ablationMarkdown(const Json& json) {
    std::string markdown = machineLine(json) + "| optimisation | | ms | change | noise | rel L2 |\n|---|---|---|---|---|---|\n";
    for (const Json& row : json["ablation"])
        markdown += fmt::format("| {} | {} | {} | {} | {} | {} |\n", text(row, "group"), text(row, "what"), cell(row, "ms", "{:.3f}"),
                                cell(row, "change", "{:+.3f}"), cell(row, "noise", "{:.3f}"),
                                row["rel_l2"].is_number() ? cell(row, "rel_l2", "{:.4f}") : "the same");
    return markdown;
}

std::string motionMarkdown(const Json& json) {
    std::string markdown = machineLine(json) + "| motion | technique | setting | rel L2 | flicker | largest step | the light itself |\n"
                                               "|---|---|---|---|---|---|---|\n";
    for (const Json& row : json["motion"])
        markdown += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", text(row, "motion"), text(row, "technique"), text(row, "setting"),
                                cell(row, "rel_l2", "{:.4f}"), cell(row, "flicker", "{:.4f}"), cell(row, "largest", "{:.4f}"),
                                cell(row, "light", "{:.4f}"));
    return markdown;
}

} // namespace

Result<std::string> toMarkdown(const std::string& json, const std::string& nameForMessages) {
    const Json parsed = Json::parse(json, nullptr, false);
    if (parsed.is_array()) return resultsMarkdown(parsed, nameForMessages);
    const bool known = parsed.is_object() && parsed.contains("machine") && parsed["machine"].is_object();
    const auto holds = [&](const char* key, std::initializer_list<const char*> members) {
        return known && parsed.contains(key) && parsed[key].is_array() && std::ranges::all_of(parsed[key], [&](const Json& item) {
                   return std::ranges::all_of(members, [&](const char* member) { return item.is_object() && item.contains(member); });
               });
    };
    if (holds("series", {"x", "ms"})) return growthMarkdown(parsed);
    if (holds("ablation", {"rel_l2"})) return ablationMarkdown(parsed);
    if (holds("motion", {"flicker"})) return motionMarkdown(parsed);
    return inputError(8076, {.file = nameForMessages}, "no results of a comparison", kFileHint);
}

} // namespace tegument::bench
