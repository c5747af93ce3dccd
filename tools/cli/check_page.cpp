#include "tools/cli/check_page.h"

#include "tools/check/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace tegument::app {

namespace {

/// The keys of `check --json` for kSm3Limits.
std::string keyOf(const Sm3Limit& limit) {
    constexpr std::array kKeys = {std::pair{&Sm3Usage::instructionSlots, "instruction_slots"}, std::pair{&Sm3Usage::constants, "constants"},
                                  std::pair{&Sm3Usage::samplers, "samplers"}, std::pair{&Sm3Usage::interpolators, "interpolators"}};
    return std::string("/") + std::ranges::find(kKeys, limit.used, [](const auto& entry) { return entry.first; })->second;
}

std::string fileOf(const Json& file) {
    const std::string variant = textAt(file, "/variant");
    return textAt(file, "/file") + (variant.empty() ? "" : fmt::format(" [{}]", variant));
}

std::string placeOf(const Json& diagnostic) {
    std::string place = textAt(diagnostic, "/file");
    for (const char* part : {"/line", "/column"})
        if (const auto value = numberAt(diagnostic, part)) place += fmt::format(":{:.0f}", *value);
    return place;
}

Json targets(const Json& files) {
    Json rows = Json::array();
    for (const Json& file : files)
        for (const Json& target : valueAt(file, "/targets"))
            rows.push_back({textAt(target, "/verdict"), fileOf(file), textAt(target, "/target"), valueAt(target, "/entries"),
                            valueAt(target, "/ms"), textAt(target, "/reason")});
    return report::table(
        "Targets",
        "Each target's own compiler was asked. Not applicable: the file has nothing for it. Not checked: this machine lacks its tool.",
        {{"", "verdict"}, {"effect"}, {"target"}, {"entry points", "number"}, {"ms", "number", "to compile"}, {"why"}}, std::move(rows));
}

void addDiagnostics(Json& rows, const Json& list, const std::string& file, const std::string& target) {
    for (const Json& diagnostic : list)
        rows.push_back({textAt(diagnostic, "/severity"), textAt(diagnostic, "/code"), file, target, placeOf(diagnostic),
                        textAt(diagnostic, "/text"), textAt(diagnostic, "/hint")});
}

Json diagnostics(const Json& files) {
    Json rows = Json::array();
    for (const Json& file : files) {
        addDiagnostics(rows, valueAt(file, "/diagnostics"), fileOf(file), "all");
        for (const Json& target : valueAt(file, "/targets"))
            addDiagnostics(rows, valueAt(target, "/diagnostics"), fileOf(file), textAt(target, "/target"));
    }
    const char* const note = rows.empty() ? "No compiler had anything to say." : "docs/diagnostics.md explains every code.";
    return report::table("Diagnostics", note,
                         {{"severity", "verdict"}, {"code", "code"}, {"effect"}, {"target"}, {"place", "code"}, {"what"}, {"what to do"}},
                         std::move(rows));
}

int limitOf(const Sm3Limit& limit, const std::string& profile) {
    return profile.starts_with("vs") ? limit.vertex : limit.pixel;
}

Json resources(const Json& files) {
    Json rows = Json::array();
    for (const Json& file : files)
        for (const Json& pass : valueAt(file, "/sm3")) {
            const std::string profile = textAt(pass, "/profile");
            Json row = {fileOf(file), textAt(pass, "/technique"), textAt(pass, "/pass"), textAt(pass, "/entry"), profile};
            for (const Sm3Limit& limit : kSm3Limits) {
                const auto used = numberAt(pass, keyOf(limit).c_str());
                row.push_back(used ? Json(*used) : Json(nullptr));
                if (limit.used == &Sm3Usage::instructionSlots) row.push_back(used ? Json(*used / limitOf(limit, profile)) : Json(nullptr));
            }
            rows.push_back(std::move(row));
        }
    std::vector<report::Column> columns = {{"effect"}, {"technique"}, {"pass"}, {"entry", "code"}, {"profile", "code"}};
    for (const Sm3Limit& limit : kSm3Limits) {
        columns.push_back(
            {std::string(limit.what), "number", fmt::format("at most {} in vs_3_0, {} in ps_3_0", limit.vertex, limit.pixel)});
        if (limit.used == &Sm3Usage::instructionSlots) columns.push_back({"of them", "share", "of what every device has"});
    }
    return report::table("Shader model 3", "What each shader takes of what every device of shader model 3 has, read from the binary.",
                         columns, std::move(rows));
}

std::string summaryOf(const Json& files) {
    std::map<std::string, std::size_t> counts;
    for (const Json& file : files)
        for (const Json& target : valueAt(file, "/targets"))
            ++counts[textAt(target, "/verdict")];
    return fmt::format("{} passed, {} failed, {} not applicable, {} not checked", counts["passed"], counts["failed"],
                       counts["not applicable"], counts["not checked"]);
}

} // namespace

std::vector<report::Figure> checkFigures(const Json& run) {
    std::vector<report::Figure> figures;
    for (const Json& file : valueAt(run, "/files")) {
        for (const Json& target : valueAt(file, "/targets"))
            if (const std::string verdict = textAt(target, "/verdict");
                verdict == verdictName(Verdict::Passed) || verdict == verdictName(Verdict::Failed))
                figures.push_back({.subject = fileOf(file),
                                   .name = textAt(target, "/target") + " fails",
                                   .value = verdict == verdictName(Verdict::Failed) ? 1.0 : 0.0});
        for (const Json& pass : valueAt(file, "/sm3"))
            for (const Sm3Limit& limit : kSm3Limits)
                if (const auto used = numberAt(pass, keyOf(limit).c_str()))
                    figures.push_back({.subject = fmt::format("{}, {} {}, {}", fileOf(file), textAt(pass, "/technique"),
                                                              textAt(pass, "/pass"), textAt(pass, "/entry")),
                                       .name = std::string(limit.what),
                                       .value = *used});
    }
    return figures;
}

report::Page checkPage(const Json& run) {
    const Json files = valueAt(run, "/files");
    report::Page page{.title = "tegument check",
                      .summary = summaryOf(files),
                      .verdict = valueAt(run, "/passed") == Json(true) ? "pass" : "fail",
                      .facts = {{"effects", fmt::format("{}", files.size())}},
                      .sections = {targets(files), diagnostics(files)}};
    Json used = resources(files);
    if (!used["rows"].empty()) page.sections.push_back(std::move(used));
    return page;
}

} // namespace tegument::app
