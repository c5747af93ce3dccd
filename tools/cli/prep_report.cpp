// What tegument prep says about a mesh, as JSON and for people.

#include "tools/cli/prep_report.h"

#include <fmt/format.h>

#include <cmath>

namespace tegument::app {

namespace {

Json countJson(const prep::Count& count) {
    return {{"vertices", count.vertices}, {"faces", count.faces}};
}

Json beforeAfter(double before, double after) {
    return {{"before", before}, {"after", after}};
}

Json sizeJson(const prep::SizeFigures& size) {
    return {{"before", size.before},
            {"after", size.after},
            {"vertex_bytes", size.vertexBytes},
            {"index_bytes", size.indexBytes},
            {"reduction", size.reduction()}};
}

Json topologyJson(const prep::Topology& t) {
    return {{"components", t.components},
            {"boundary_edges", t.boundaryEdges},
            {"crowded_edges", t.crowdedEdges},
            {"opposed_edges", t.opposedEdges},
            {"bow_ties", t.bowTies},
            {"back_to_back_pairs", t.backToBackPairs},
            {"flat_triangles", t.flatTriangles}};
}

Json mappingJson(const std::vector<prep::MappingFigures>& mapping) {
    Json list = Json::array();
    for (const prep::MappingFigures& m : mapping) {
        list.push_back({{"name", m.name},
                        {"cv_face", m.cvFace},
                        {"cv_patch", m.cvPatch},
                        {"density", {{"p1", m.density1}, {"p50", m.density50}, {"p99", m.density99}}},
                        {"anisotropy", {{"p50", m.anisotropy50}, {"p95", m.anisotropy95}}},
                        {"starved", m.starved},
                        {"mirrored", m.mirrored},
                        {"one_texel", m.oneTexel},
                        {"seam_length", m.seamLength}});
        if (m.seamJumpTexels) list.back()["seam_jump_texels"] = *m.seamJumpTexels;
    }
    return list;
}

Json rootMappingJson(const std::vector<prep::RootMapping>& mapping) {
    Json list = Json::array();
    for (const prep::RootMapping& m : mapping)
        list.push_back({{"name", m.name},
                        {"strands", m.count},
                        {"cv_patch", m.cvPatch},
                        {"cv_independent", m.poissonCv},
                        {"starved", m.starved},
                        {"largest_gap_spacings", m.largestGap},
                        {"seam_length", m.seamLength}});
    return list;
}

void printRootMapping(const std::vector<prep::RootMapping>& mapping) {
    std::vector<std::vector<std::string>> rows;
    for (const prep::RootMapping& m : mapping)
        rows.push_back({m.name, fmt::format("{}", m.count), fmt::format("{:.3f}", m.cvPatch), fmt::format("{:.3f}", m.poissonCv),
                        fmt::format("{:.2f} %", 100 * m.starved), fmt::format("{:.2f}", m.largestGap),
                        fmt::format("{:.2f}", m.seamLength)});
    fmt::print("{}\n", table({"by rest position", "strands", "CV patches", "independent", "starved", "largest gap", "seam"}, rows));
}

void printMapping(const std::vector<prep::MappingFigures>& mapping) {
    std::vector<std::vector<std::string>> rows;
    for (const prep::MappingFigures& m : mapping)
        rows.push_back({m.name, fmt::format("{:.2f}", m.cvFace), fmt::format("{:.2f}", m.cvPatch), fmt::format("{:.2f}", m.anisotropy50),
                        fmt::format("{:.1f}", m.anisotropy95), fmt::format("{:.1f} %", 100 * m.starved),
                        fmt::format("{:.1f} %", 100 * m.mirrored), fmt::format("{:.1f} %", 100 * m.oneTexel),
                        fmt::format("{:.2f}", m.seamLength)});
    fmt::print("{}\n", table({"mapping", "CV faces", "CV patches", "anisotropy", "p95", "starved", "mirrored", "one texel", "seam"}, rows));
}

} // namespace

Json reportJson(const prep::PrepReport& report, const std::string& input, const std::string& output) {
    Json json{{"input", countJson(report.input)}, {"steps", Json::array()}, {"output", countJson(report.output)}};
    json["input"]["file"] = input;
    json["output"]["file"] = output.empty() ? Json(nullptr) : Json(output);
    for (const prep::PrepStep& step : report.steps)
        json["steps"].push_back({{"name", step.name}, {"changed", step.changed}, {"text", step.text}, {"seconds", step.seconds}});
    for (const prep::CacheComparison& c : report.cache) {
        json["acmr"][std::string(c.model.name)] = beforeAfter(c.before.acmr(), c.after.acmr());
        json["atvr"][std::string(c.model.name)] = beforeAfter(c.before.atvr(), c.after.atvr());
    }
    json["bytes"] = sizeJson(report.bytes);
    json["bytes_seed"] = sizeJson(report.seedBytes);
    const auto list = [](const glm::dvec3& v) -> Json { return {v.x, v.y, v.z}; };
    json["centre"] = {{"moved", list(report.centring.moved)},
                      {"place", list(report.centring.place)},
                      {"radius", report.centring.radius},
                      {"minimal_radius", report.centring.minimalRadius}};
    json["places"] = {{"joined", report.places.joined}, {"cracks", report.places.cracks}, {"crack_width_mm", report.places.crackWidth}};
    if (!report.mapping.empty()) json["mapping"] = mappingJson(report.mapping);
    if (!report.rootMapping.empty()) json["mapping_roots"] = rootMappingJson(report.rootMapping);
    json["topology"] = topologyJson(report.topology);
    json["levels"] = Json::array();
    for (const prep::LevelFigures& level : report.levels)
        json["levels"].push_back({{"faces", level.triangles},
                                  {"error_mm", told(level.error)},
                                  {"error_at_most_mm", level.error.greatest},
                                  {"rms_mm", level.error.rms}});
    if (report.overdraw) json["overdraw"] = beforeAfter(report.overdraw->before, report.overdraw->after);
    json["precision"] = {
        {"position_mm", report.precision.positionMm}, {"normal_degrees", report.precision.normalDegrees}, {"uv", report.precision.uv}};
    json["chunks"] = {{"count", report.chunks.count}, {"duplicates", report.chunks.duplicates}};
    json["warnings"] = toJson(report.warnings);
    return json;
}

void printReport(const prep::PrepReport& report) {
    std::vector<std::vector<std::string>> rows;
    for (const prep::PrepStep& step : report.steps)
        fmt::print("{:<14}{}\n", step.name, step.text);
    for (const prep::CacheComparison& c : report.cache)
        rows.push_back({std::string(c.model.name), fmt::format("{:.3f}", c.before.acmr()), fmt::format("{:.3f}", c.after.acmr()),
                        fmt::format("{:.3f}", c.before.atvr()), fmt::format("{:.3f}", c.after.atvr())});
    if (!report.mapping.empty()) printMapping(report.mapping);
    if (!report.rootMapping.empty()) printRootMapping(report.rootMapping);
    if (report.output.faces > 0) fmt::print("\n{}\n", table({"cache", "ACMR before", "after", "ATVR before", "after"}, rows));
    const double less = 100 * report.bytes.reduction(); // a few triangles that share no vertex have indices on top
    fmt::print(
        "{} vertices, {} triangles; {} bytes with {}-byte vertices and {}-byte indices, {:.2f} % {} than {} triangles on their own\n",
        report.output.vertices, report.output.faces, report.bytes.after, report.bytes.vertexBytes, report.bytes.indexBytes, std::abs(less),
        less < 0 ? "more" : "less", report.output.faces);
}

} // namespace tegument::app
