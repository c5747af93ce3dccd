#include "tools/cli/prep_page.h"

#include <fmt/format.h>

#include <array>

namespace tegument::app {

namespace {

std::string integerAt(const Json& json, const char* place) {
    return fmt::format("{:.0f}", numberAt(json, place).value_or(0));
}

Json steps(const Json& run) {
    Json rows = Json::array();
    for (const Json& step : valueAt(run, "/steps"))
        rows.push_back({textAt(step, "/name"), valueAt(step, "/changed"), textAt(step, "/text"), valueAt(step, "/seconds")});
    return report::table("Steps", "What each step changed, in their order.",
                         {{"step"}, {"changed", "number", "faces, vertices or places"}, {"what"}, {"seconds", "number"}}, std::move(rows));
}

Json timeline(const Json& run) {
    Json parts = Json::array();
    for (const Json& step : valueAt(run, "/steps"))
        parts.push_back({{"name", textAt(step, "/name")}, {"value", numberAt(step, "/seconds").value_or(0)}});
    Json rows = Json::array();
    if (!parts.empty()) rows.push_back({{"name", textAt(run, "/input/file")}, {"parts", std::move(parts)}});
    return {{"kind", "timeline"},
            {"title", "Where the time went"},
            {"note", "Open the row for its figures."},
            {"unit", "s"},
            {"rows", std::move(rows)}};
}

void addBeforeAfter(Json& rows, const std::string& what, const Json& pair) {
    const auto before = numberAt(pair, "/before");
    const auto after = numberAt(pair, "/after");
    if (before && after) rows.push_back({what, *before, *after, *before != 0 ? Json(100 * (*after / *before - 1)) : Json(nullptr)});
}

Json beforeAfter(const Json& run) {
    Json rows = Json::array();
    for (const char* corner : {"vertices", "faces"})
        addBeforeAfter(rows, corner,
                       {{"before", valueAt(run, (std::string("/input/") + corner).c_str())},
                        {"after", valueAt(run, (std::string("/output/") + corner).c_str())}});
    addBeforeAfter(rows, "bytes of vertices and indices", valueAt(run, "/bytes"));
    for (const auto& [place, name] :
         {std::pair{"/acmr", "vertices shaded per triangle (ACMR)"}, {"/atvr", "vertices shaded per vertex (ATVR)"}}) {
        const Json models = valueAt(run, place);
        for (const auto& [model, pair] : models.items())
            addBeforeAfter(rows, fmt::format("{}, {}", name, model), pair);
    }
    addBeforeAfter(rows, "overdraw", valueAt(run, "/overdraw"));
    return report::table("Before and after", "Less is better; ACMR and ATVR are of a cache of the named kind.",
                         {{"figure"}, {"before", "number"}, {"after", "number"}, {"change, %", "number"}}, std::move(rows));
}

/// The full mesh has no error: it has no place on a logarithmic scale.
Json levels(const Json& run) {
    Json points = Json::array();
    int number = 1;
    for (const Json& level : valueAt(run, "/levels"))
        points.push_back(
            {{"name", fmt::format("level {}", number++)},
             {"group", "levels of detail"},
             {"mark", "level"},
             {"facets", Json::object()},
             {"values",
              {{"faces", valueAt(level, "/faces")}, {"greatest", valueAt(level, "/error_mm")}, {"rms", valueAt(level, "/rms_mm")}}}});
    return {{"kind", "scatter"},
            {"title", "Levels of detail"},
            {"note", "How far each coarser level lies from the full mesh."},
            {"axes",
             {{"x", {{{"key", "faces"}, {"title", "triangles"}}}},
              {"y", {{{"key", "greatest"}, {"title", "greatest distance, mm"}}, {{"key", "rms"}, {"title", "root mean square, mm"}}}}}},
            {"points", std::move(points)}};
}

Json topology(const Json& run) {
    constexpr std::array kRows = {std::array{"components", "parts that no edge joins"},
                                  std::array{"boundary_edges", "edges with a triangle on one side only: holes and rims"},
                                  std::array{"crowded_edges", "edges of more than two triangles"},
                                  std::array{"opposed_edges", "edges whose triangles face opposite ways"},
                                  std::array{"bow_ties", "places where surfaces touch in one point"},
                                  std::array{"back_to_back_pairs", "triangles that lie on each other, facing away"},
                                  std::array{"flat_triangles", "triangles without area"}};
    Json rows = Json::array();
    for (const auto& [key, meaning] : kRows)
        rows.push_back({std::string(key), valueAt(run, (std::string("/topology/") + key).c_str()), meaning});
    return report::table("Topology of what is written", {}, {{"figure"}, {"count", "number"}, {"what it is"}}, std::move(rows));
}

Json mapping(const Json& run) {
    Json rows = Json::array();
    const Json list = valueAt(run, "/mapping");
    for (const Json& one : list)
        rows.push_back({textAt(one, "/name"), valueAt(one, "/cv_face"), valueAt(one, "/cv_patch"), valueAt(one, "/anisotropy/p50"),
                        valueAt(one, "/anisotropy/p95"), valueAt(one, "/starved"), valueAt(one, "/mirrored"),
                        valueAt(one, "/seam_length")});
    return report::table("How evenly textures lie", "By --mapping-report: less is better in every column.",
                         {{"mapping"},
                          {"CV of faces", "number", "spread of texels per area, face by face"},
                          {"CV of patches", "number"},
                          {"stretch", "number", "median of the longer over the shorter axis of a texel"},
                          {"p95", "number"},
                          {"starved", "number", "share of the area with few texels"},
                          {"mirrored", "number"},
                          {"seams", "number", "length of the seams"}},
                         std::move(rows));
}

Json warnings(const Json& run) {
    Json rows = Json::array();
    for (const Json& one : valueAt(run, "/warnings"))
        rows.push_back({textAt(one, "/severity"), textAt(one, "/code"), textAt(one, "/text"), textAt(one, "/hint")});
    return report::table("Warnings", {}, {{"severity", "verdict"}, {"code", "code"}, {"what"}, {"what to do"}}, std::move(rows));
}

} // namespace

std::vector<report::Figure> prepFigures(const Json& run) {
    std::vector<report::Figure> figures;
    const std::string mesh = textAt(run, "/input/file");
    const auto add = [&](const std::string& name, const std::optional<double>& value) {
        if (value) figures.push_back({.subject = mesh, .name = name, .value = *value});
    };
    if (mesh.empty()) return figures;
    add("bytes", numberAt(run, "/bytes/after"));
    const Json cache = valueAt(run, "/acmr");
    for (const auto& [model, pair] : cache.items())
        add("vertices shaded per triangle, " + model, numberAt(pair, "/after"));
    int level = 1;
    for (const Json& one : valueAt(run, "/levels"))
        add(fmt::format("error of level {}, mm", level++), numberAt(one, "/error_mm"));
    double seconds = 0;
    for (const Json& step : valueAt(run, "/steps"))
        seconds += numberAt(step, "/seconds").value_or(0);
    add("seconds", seconds);
    add("position error, mm", numberAt(run, "/precision/position_mm"));
    return figures;
}

report::Page prepPage(const Json& run) {
    report::Page page{.title = "tegument prep",
                      .summary = fmt::format("{}: {} vertices and {} triangles out of {} vertices and {} faces", textAt(run, "/input/file"),
                                             integerAt(run, "/output/vertices"), integerAt(run, "/output/faces"),
                                             integerAt(run, "/input/vertices"), integerAt(run, "/input/faces")),
                      .verdict = {},
                      .facts = {},
                      .sections = {}};
    if (const std::string output = textAt(run, "/output/file"); !output.empty()) page.facts.emplace_back("written to", output);
    if (Json list = warnings(run); !list["rows"].empty()) page.sections.push_back(std::move(list));
    page.sections.insert(page.sections.end(), {steps(run), timeline(run), beforeAfter(run)});
    if (Json list = levels(run); !list["points"].empty()) page.sections.push_back(std::move(list));
    page.sections.push_back(topology(run));
    if (Json list = mapping(run); !list["rows"].empty()) page.sections.push_back(std::move(list));
    return page;
}

} // namespace tegument::app
