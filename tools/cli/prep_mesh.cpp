// tegument prep IN -o OUT: any mesh made clean, indexed and ordered.

#include "tools/cli/prep_mesh.h"

#include "host/mesh/motion.h"
#include "host/mesh/read_mesh.h"
#include "host/support/file.h"
#include "host/support/left_out.h"
#include "host/support/text.h"
#include "meshprep/assets/names.h"
#include "meshprep/prepare/manifold_levels.h"
#include "meshprep/prepare/prepare.h"
#include "meshprep/write/write_mesh.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"
#include "tools/cli/report_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>

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

/// `output` is empty when nothing was written.
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

/// Of what --report writes: cache misses, bytes, errors of levels, seconds.
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
                                             integerAt(run, "/input/vertices"), integerAt(run, "/input/faces"))};
    if (const std::string output = textAt(run, "/output/file"); !output.empty()) page.facts.emplace_back("written to", output);
    if (Json list = warnings(run); !list["rows"].empty()) page.sections.push_back(std::move(list));
    page.sections.insert(page.sections.end(), {steps(run), timeline(run), beforeAfter(run)});
    if (Json list = levels(run); !list["points"].empty()) page.sections.push_back(std::move(list));
    page.sections.push_back(topology(run));
    if (Json list = mapping(run); !list["rows"].empty()) page.sections.push_back(std::move(list));
    return page;
}

struct Arguments {
    std::string input;
    std::string output;
    std::string report;
    ReportOptions page;
    bool dryRun = false;
    bool json = false;
    bool refuseNotFinite = false;
    std::string up; // y or z; empty: as files of that format usually have it
    std::string order = "best";
    std::string cache = "warp";
    std::set<std::string> created; // folders
    prep::PrepOptions options;
};

/// Whether what is written holds more than the full mesh in one piece.
bool holdsParts(const Arguments& arguments) {
    const MeshWriter* output = meshWriterOf(arguments.output);
    return !output || output->holdsParts;
}

Json reportOf(const Arguments& arguments, const prep::PrepReport& report) {
    return reportJson(report, arguments.input, arguments.dryRun ? "" : arguments.output);
}

Result<void> write(const Arguments& arguments, const prep::Prepared& prepared) {
    if (!arguments.dryRun) {
        const auto written = meshWriterOf(arguments.output)->write(arguments.output, prepared.mesh, prepared.glb);
        if (!written) return written.error();
    }
    if (arguments.report.empty()) return {};
    return writeFile(arguments.report, reportOf(arguments, prepared.report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
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

Result<void> checkLevels(const prep::PrepOptions& options) {
    if (options.levelMethod != prep::LevelMethod::OpenMesh || prep::ManifoldSimplifier::available()) return {};
    return leftOut("OpenMesh, and with it --levels-by openmesh", "without it, levels are meshoptimizer's");
}

Result<void> inputExists(const Arguments& arguments) {
    return assets::fileExists(arguments.input, "the mesh", {"human", "shape", "bunny"});
}

Result<void> checkFiles(const Arguments& arguments) {
    if (arguments.input.empty()) return usageError(8041, "which mesh?", "tegument prep IN -o OUT.glb, or tegument prep human");
    if (!std::filesystem::path(arguments.input).has_extension()) // rather a misspelt command than a mesh
        if (const auto exists = inputExists(arguments); !exists) return exists.error();
    if (const auto can = checkOutput(arguments.report, {}); !can) return can.error();
    if (arguments.dryRun) return {};
    if (arguments.output.empty()) return usageError(8040, "where should the prepared mesh go?", "-o OUT.glb or OUT.ply, or --dry-run");
    if (!meshWriterOf(arguments.output))
        return usageError(8042, fmt::format("cannot write a mesh as '{}'", arguments.output), "name it OUT.glb or OUT.ply");
    return checkOutput(arguments.output, {});
}

/// What a file of one piece has no place for.
void warnOfLost(const prep::Prepared& prepared, const std::string& output) {
    const Mesh& mesh = prepared.mesh;
    std::string lost;
    const auto add = [&](std::size_t count, const char* what) {
        if (count > 0) lost += fmt::format("{}{} {}", lost.empty() ? "" : ", ", count, what);
    };
    std::set<std::uint32_t> materials;
    for (const MeshPart& part : mesh.parts)
        if (part.material) materials.insert(*part.material);
    add(mesh.parts.size() > 1 ? mesh.parts.size() : 0, "parts");
    add(materials.size(), "materials");
    add(mesh.materials.images.size(), "pictures");
    std::size_t targets = 0;
    for (const MotionRun& run : mesh.motion ? mesh.motion->runs : std::vector<MotionRun>())
        targets = std::max(targets, run.targets.size());
    add(mesh.motion ? mesh.motion->animations.size() : 0, "animations");
    add(mesh.motion ? mesh.motion->skins.size() : 0, "skins");
    add(targets, "morph targets");
    if (lost.empty()) return;
    warn({inputWarning(5331, {}, fmt::format("a {} file keeps none of {}", meshWriterOf(output)->name, lost), "write a glb to keep them")});
}

/// The folders that writing will create, the outermost one.
std::string folderToMake(const std::string& path) {
    std::filesystem::path folder = std::filesystem::path(path).parent_path();
    std::string missing;
    for (std::error_code code; !folder.empty() && !std::filesystem::exists(folder, code); folder = folder.parent_path())
        missing = folder.string();
    return missing;
}

void tellWhatWasWritten(const Arguments& arguments) {
    for (const std::string& folder : arguments.created)
        fmt::print("created the folder {}\n", folder);
    if (!arguments.dryRun) fmt::print("wrote {}\n", arguments.output);
    if (!arguments.report.empty()) fmt::print("wrote {}\n", arguments.report);
    if (arguments.options.unwrap && !arguments.dryRun)
        fmt::print("skin without seams between its charts: tegument render Pyramid -t PyramidLinked --mesh {}\n",
                   shellWord(arguments.output));
}

int run(Arguments& arguments) {
    if (const auto fine = checkFiles(arguments); !fine) return fail(fine.error(), arguments.json);
    if (!holdsParts(arguments)) arguments.options.levels = 1;
    arguments.options.guessUnit = true;
    const MeshFormat* input = meshFormatOf(arguments.input);
    arguments.options.turnUp = arguments.up.empty() ? input && input->zIsUp : arguments.up == "z";
    arguments.options.read.dropNotFinite = !arguments.refuseNotFinite;
    if (const auto set = setOrder(arguments); !set) return fail(set.error(), arguments.json);
    if (const auto can = checkLevels(arguments.options); !can) return fail(can.error(), arguments.json);
    if (const auto exists = inputExists(arguments); !exists) return fail(exists.error(), arguments.json);
    const auto earlier = earlierRun(arguments.page, prepFigures);
    if (!earlier) return fail(earlier.error(), arguments.json);
    Progress progress;
    arguments.options.progress = [&](const std::string& step) { progress.say(step); };
    const auto prepared = prep::prepareMesh(arguments.input, arguments.options);
    progress.clear();
    if (!prepared) return fail(prepared.error(), arguments.json);
    warn(prepared->report.warnings);
    if (!holdsParts(arguments)) warnOfLost(*prepared, arguments.output);
    for (const std::string& path : {arguments.dryRun ? std::string() : arguments.output, arguments.report})
        if (const std::string folder = folderToMake(path); !folder.empty()) arguments.created.insert(folder);
    if (const auto written = write(arguments, *prepared); !written) return fail(written.error(), arguments.json);
    if (arguments.json) {
        print(reportOf(arguments, prepared->report));
    } else {
        printReport(prepared->report);
        tellWhatWasWritten(arguments);
    }
    const Json made = reportOf(arguments, prepared->report);
    const auto told = tellReport(arguments.page, *earlier, made, prepFigures, [&] { return prepPage(made); });
    if (!told) return fail(told.error(), false);
    return 0;
}

void addReading(CLI::App& command, Arguments& arguments) {
    ReadOptions& read = arguments.options.read;
    command.add_option("--unit-mm", read.unitMm, "Millimetres per unit of the file; default: 1000 for glTF, else 1, or what is likely");
    command
        .add_option("--up", arguments.up,
                    fmt::format("Which axis of the file points up, y or z; default: {}. Of what is written it is y", meshUps()))
        ->transform(oneOf({"y", "z"}));
    command.add_flag("--drop-bad-faces", read.dropBadFaces, "Leave out faces that refer to no vertex, instead of refusing the file");
    command.add_flag("--anywhere", read.roots.anywhere,
                     "Buffers and pictures that the file names may lie outside of its folder and project");
    command.add_flag("--refuse-not-finite", arguments.refuseNotFinite,
                     "Refuse a file with NaN or infinity, instead of leaving out its faces");
}

void addCleaning(CLI::App& command, prep::PrepOptions& options) {
    command.add_option(
        "--weld-epsilon", options.same.epsilon,
        "Vertices at most this far apart (in mm) are at one place; 0: exactly. Default: exactly, and cracks as wide as the last "
        "digit of the file's numbers are closed");
    command.add_option("--weld-decimals", options.same.decimals,
                       "Vertices whose coordinates print alike with this many decimals are at one place");
    command.add_flag("--keep-duplicates", options.keepDuplicates, "Keep triangles that repeat another");
    command.add_flag(
        "--orient", options.orient,
        "Turn triangles that face otherwise than most of their component, and what is inside out; keep one side of what is there twice");
}

void addShaping(CLI::App& command, prep::PrepOptions& options) {
    using prep::CentreMode, prep::NormalMode, prep::NormalSharing;
    command
        .add_option("--centre", options.centre, "ball: minimal bounding ball (default); box: middle of the box, half its diagonal; none")
        ->type_name("WORD")
        ->transform(oneOf<CentreMode>({{"ball", CentreMode::Ball}, {"box", CentreMode::Box}, {"none", CentreMode::None}}));
    command
        .add_option("--normals", options.normals.mode,
                    "angle: weighted by angle (default); sum: of all; seed: of all that differ in a bit; unique-tolerance: of all that "
                    "differ by more than 0.26 degrees; keep: the file's")
        ->type_name("WORD")
        ->transform(oneOf<NormalMode>({{"angle", NormalMode::Angle},
                                       {"sum", NormalMode::Sum},
                                       {"seed", NormalMode::Seed},
                                       {"unique-tolerance", NormalMode::UniqueTolerance},
                                       {"keep", NormalMode::Keep}}));
    command
        .add_option(
            "--normals-per", options.normals.sharing,
            "What shares a normal. place: everything at one place; sheet: not the two sides of parts that lie back to back (default); "
            "fan: only triangles that are joined by edges")
        ->type_name("WORD")
        ->transform(oneOf<NormalSharing>({{"place", NormalSharing::Place}, {"sheet", NormalSharing::Sheet}, {"fan", NormalSharing::Fan}}));
}

void addUnwrapping(CLI::App& command, prep::PrepOptions& options) {
    command.add_flag("--unwrap", options.unwrap,
                     "Make texture coordinates: charts without overlap; the file's pictures are drawn anew for them");
    command.add_flag("--flip-v", options.flipV, "The file's v runs against its format's convention (tegument portrait finds that)");
}

void addOrdering(CLI::App& command, Arguments& arguments) {
    command.add_option("--order", arguments.order, "file, lin-yu, hoppe, tipsify, meshopt, best")->capture_default_str();
    command.add_option("--cache", arguments.cache, "What the order is for: fifo:K, lru:K, warp")->capture_default_str();
    command.add_flag("--overdraw", arguments.options.overdraw, "Then put triangles that hide others first; reuse gets at most 5 % worse");
}

void addStoring(CLI::App& command, prep::PrepOptions& options) {
    using prep::VertexPrecision;
    command.add_option("--levels", options.levels, "Levels of detail in a glb, the full mesh counted; each has a quarter of the triangles")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
    command
        .add_option("--levels-by", options.levelMethod,
                    "meshoptimizer (default): fast; openmesh: slow; what is a 2-manifold without seams stays one (docs/meshprep.md)")
        ->type_name("WORD")
        ->transform(
            oneOf<prep::LevelMethod>({{"meshoptimizer", prep::LevelMethod::Meshoptimizer}, {"openmesh", prep::LevelMethod::OpenMesh}}));
    command.add_option("--vertex", options.precision, "Numbers of a vertex: float (default), half, unorm16; the report states the error")
        ->type_name("WORD")
        ->transform(oneOf<VertexPrecision>(
            {{"float", VertexPrecision::Float}, {"half", VertexPrecision::Half}, {"unorm16", VertexPrecision::Unorm16}}));
    command.add_flag("--chunk16", options.chunk16, "Cut meshes of more than 65,535 vertices into pieces with 16-bit indices");
}

} // namespace

void addPrepMesh(CLI::App& command, Action& action) {
    auto arguments = std::make_shared<Arguments>();
    command.add_option("input", arguments->input, fmt::format("Mesh to prepare ({})", meshEndings()));
    command.add_option("-o,--output", arguments->output, "Where it goes: .glb or .ply");
    command.add_option("--report", arguments->report, "Write what each step changed, and the figures before and after, as JSON");
    addReportOptions(command, arguments->page, "--report");
    command.add_flag("--mapping-report", arguments->options.mappingReport, "How evenly textures would lie on it (docs/meshprep.md)");
    command.add_flag("--dry-run", arguments->dryRun, "Do everything but write the mesh");
    command.add_flag("--json", arguments->json, "Print the report as JSON");
    addReading(command, *arguments);
    addCleaning(command, arguments->options);
    addShaping(command, arguments->options);
    addUnwrapping(command, arguments->options);
    addOrdering(command, *arguments);
    addStoring(command, arguments->options);
    command.callback([&command, arguments, &action] {
        if (!command.get_subcommands().empty()) return;
        action = [arguments] { return run(*arguments); };
    });
}

} // namespace tegument::app
