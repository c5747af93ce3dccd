// tegument prep IN -o OUT: any mesh made clean, indexed and ordered.

#include "host/app/prep_mesh.h"

#include "host/app/output.h"
#include "host/support/file.h"
#include "host/support/text.h"
#include "meshprep/prepare/prepare.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <map>
#include <memory>

namespace tegument::app {

namespace {

struct Arguments {
    std::string input;
    std::string output;
    std::string report;
    bool dryRun = false;
    bool json = false;
    bool refuseNotFinite = false;
    std::string order = "best";
    std::string cache = "warp";
    prep::PrepOptions options;
};

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

Json reportJson(const Arguments& arguments, const prep::PrepReport& report) {
    Json json{{"input", countJson(report.input)}, {"steps", Json::array()}, {"output", countJson(report.output)}};
    json["input"]["file"] = arguments.input;
    json["output"]["file"] = arguments.dryRun ? Json(nullptr) : Json(arguments.output);
    for (const prep::PrepStep& step : report.steps)
        json["steps"].push_back({{"name", step.name}, {"changed", step.changed}, {"text", step.text}, {"seconds", step.seconds}});
    for (const prep::CacheComparison& c : report.cache) {
        json["acmr"][std::string(c.model.name)] = beforeAfter(c.before.acmr(), c.after.acmr());
        json["atvr"][std::string(c.model.name)] = beforeAfter(c.before.atvr(), c.after.atvr());
    }
    json["bytes"] = sizeJson(report.bytes);
    json["bytes_seed"] = sizeJson(report.seedBytes);
    const glm::vec3& moved = report.centring.moved;
    json["centre"] = {
        {"moved", {moved.x, moved.y, moved.z}}, {"radius", report.centring.radius}, {"minimal_radius", report.centring.minimalRadius}};
    json["topology"] = topologyJson(report.topology);
    json["levels"] = Json::array();
    for (const prep::LevelFigures& level : report.levels)
        json["levels"].push_back({{"faces", level.triangles}, {"error_mm", level.error.greatest}, {"rms_mm", level.error.rms}});
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
    if (report.output.faces > 0) fmt::print("\n{}\n", table({"cache", "ACMR before", "after", "ATVR before", "after"}, rows));
    fmt::print(
        "{} vertices, {} triangles; {} bytes with {}-byte vertices and {}-byte indices, {:.2f} % less than {} triangles on their own\n",
        report.output.vertices, report.output.faces, report.bytes.after, report.bytes.vertexBytes, report.bytes.indexBytes,
        100 * report.bytes.reduction(), report.output.faces);
}

Result<void> write(const Arguments& arguments, const prep::Prepared& prepared) {
    if (!arguments.dryRun) {
        const auto extension = toLower(std::filesystem::path(arguments.output).extension().string());
        const auto written =
            extension == ".ply" ? writePly(arguments.output, prepared.mesh) : writeGlb(arguments.output, prepared.mesh, prepared.glb);
        if (!written) return written;
    }
    if (arguments.report.empty()) return {};
    return writeFile(arguments.report, reportJson(arguments, prepared.report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

Result<void> setOrder(Arguments& arguments) {
    const auto cache = order::parseCacheModel(arguments.cache);
    if (!cache) return cache.error();
    arguments.options.cache = *cache;
    arguments.options.order = std::nullopt;
    if (arguments.order == "file") return {};
    const auto method = order::parseMethod(arguments.order);
    if (!method) return method.error();
    arguments.options.order = *method;
    return {};
}

int run(Arguments& arguments) {
    if (arguments.input.empty())
        return fail(usageError(8041, "which mesh?", "tegument prep IN -o OUT.glb, or tegument prep human"), arguments.json);
    if (!arguments.dryRun && arguments.output.empty())
        return fail(usageError(8040, "where should the prepared mesh go?", "-o OUT.glb or OUT.ply, or --dry-run"), arguments.json);
    arguments.options.read.dropNotFinite = !arguments.refuseNotFinite;
    if (const auto set = setOrder(arguments); !set) return fail(set.error(), arguments.json);
    Progress progress;
    arguments.options.progress = [&](const std::string& step) { progress.say(step); };
    const auto prepared = prep::prepareMesh(arguments.input, arguments.options);
    progress.clear();
    if (!prepared) return fail(prepared.error(), arguments.json);
    warn(prepared->report.warnings);
    if (const auto written = write(arguments, *prepared); !written) return fail(written.error(), arguments.json);
    if (arguments.json)
        print(reportJson(arguments, prepared->report));
    else
        printReport(prepared->report);
    return 0;
}

} // namespace

namespace {

template <class Enum>
CLI::CheckedTransformer names(std::map<std::string, Enum> values) {
    return CLI::CheckedTransformer(std::move(values), CLI::ignore_case);
}

void addReading(CLI::App& command, Arguments& arguments) {
    ReadOptions& read = arguments.options.read;
    command.add_option("--unit-mm", read.unitMm, "Millimetres per unit of the file; default: 1000 for glTF, else 1");
    command.add_flag("--drop-bad-faces", read.dropBadFaces, "Leave out faces that refer to no vertex, instead of refusing the file");
    command.add_flag("--refuse-not-finite", arguments.refuseNotFinite,
                     "Refuse a file with NaN or infinity, instead of leaving out its faces");
}

void addCleaning(CLI::App& command, prep::PrepOptions& options) {
    command.add_option("--weld-epsilon", options.same.epsilon, "Vertices at most this far apart (in mm) are at one place")
        ->capture_default_str();
    command.add_option("--weld-decimals", options.same.decimals,
                       "Vertices whose coordinates print alike with this many decimals are at one place");
    command.add_flag("--keep-duplicates", options.keepDuplicates, "Keep triangles that repeat another");
    command.add_flag("--orient", options.orient, "Turn triangles that face otherwise than most of their component");
}

void addShaping(CLI::App& command, prep::PrepOptions& options) {
    using prep::CentreMode, prep::NormalMode, prep::NormalSharing;
    command
        .add_option("--centre", options.centre, "ball: minimal bounding ball (default); box: middle of the box, half its diagonal; none")
        ->transform(names<CentreMode>({{"ball", CentreMode::Ball}, {"box", CentreMode::Box}, {"none", CentreMode::None}}));
    command
        .add_option("--normals", options.normals.mode,
                    "angle: weighted by angle (default); sum: of all; seed: of all that differ in a bit; unique-tolerance: of all that "
                    "differ by more than 0.26 degrees; keep: the file's")
        ->transform(names<NormalMode>({{"angle", NormalMode::Angle},
                                       {"sum", NormalMode::Sum},
                                       {"seed", NormalMode::Seed},
                                       {"unique-tolerance", NormalMode::UniqueTolerance},
                                       {"keep", NormalMode::Keep}}));
    command
        .add_option("--normals-per", options.normals.sharing,
                    "place: everything at one place shares a normal (default); fan: only triangles that are joined by edges")
        ->transform(names<NormalSharing>({{"place", NormalSharing::Place}, {"fan", NormalSharing::Fan}}));
}

void addOrdering(CLI::App& command, Arguments& arguments) {
    command.add_option("--order", arguments.order, "file, lin-yu, hoppe, tipsify, meshopt, best")->capture_default_str();
    command.add_option("--cache", arguments.cache, "What the order is for: fifo:K, lru:K, warp")->capture_default_str();
    command.add_flag("--overdraw", arguments.options.overdraw, "Then put triangles that hide others first; reuse gets at most 5 % worse");
}

void addStoring(CLI::App& command, prep::PrepOptions& options) {
    using prep::VertexPrecision;
    command.add_option("--levels", options.levels, "Levels of detail, the full mesh counted; each has a quarter of the triangles")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
    command.add_option("--vertex", options.precision, "Numbers of a vertex: float (default), half, unorm16; the report states the error")
        ->transform(names<VertexPrecision>(
            {{"float", VertexPrecision::Float}, {"half", VertexPrecision::Half}, {"unorm16", VertexPrecision::Unorm16}}));
    command.add_flag("--chunk16", options.chunk16, "Cut meshes of more than 65,535 vertices into pieces with 16-bit indices");
}

} // namespace

void addPrepMesh(CLI::App& command, Action& action) {
    auto arguments = std::make_shared<Arguments>();
    command.add_option("input", arguments->input, "Mesh to prepare: PLY, OBJ, STL, OFF, glb or glTF");
    command.add_option("-o,--output", arguments->output, "Where it goes: .glb or .ply");
    command.add_option("--report", arguments->report, "Write what each step changed, and the figures before and after, as JSON");
    command.add_flag("--dry-run", arguments->dryRun, "Do everything but write the mesh");
    command.add_flag("--json", arguments->json, "Print the report as JSON");
    addReading(command, *arguments);
    addCleaning(command, arguments->options);
    addShaping(command, arguments->options);
    addOrdering(command, *arguments);
    addStoring(command, arguments->options);
    command.callback([&command, arguments, &action] {
        if (!command.get_subcommands().empty()) return;
        action = [arguments] { return run(*arguments); };
    });
}

} // namespace tegument::app
