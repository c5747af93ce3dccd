// tegument prep IN -o OUT: any mesh made clean, indexed and ordered.

#include "tools/cli/prep_mesh.h"

#include "host/support/file.h"
#include "host/support/left_out.h"
#include "host/support/text.h"
#include "meshprep/assets/names.h"
#include "meshprep/prepare/manifold_levels.h"
#include "tools/cli/command_line.h"
#include "tools/cli/prep_page.h"
#include "tools/cli/prep_report.h"

#include <fmt/format.h>

#include <memory>
#include <set>

namespace tegument::app {

namespace {

struct Arguments {
    std::string input;
    std::string output;
    std::string report;
    ReportOptions page;
    bool dryRun = false;
    bool json = false;
    bool refuseNotFinite = false;
    std::string up; // y or z; empty: z of STL files, else y
    std::string order = "best";
    std::string cache = "warp";
    std::set<std::string> created; // folders
    prep::PrepOptions options;
};

std::string endingOf(const std::string& path) {
    return toLower(std::filesystem::path(path).extension().string());
}

Json reportOf(const Arguments& arguments, const prep::PrepReport& report) {
    return reportJson(report, arguments.input, arguments.dryRun ? "" : arguments.output);
}

Result<void> write(const Arguments& arguments, const prep::Prepared& prepared) {
    if (!arguments.dryRun) {
        const auto extension = toLower(std::filesystem::path(arguments.output).extension().string());
        const auto written = extension == ".ply" ? writePly(arguments.output, prepared.mesh, prepared.glb.moved)
                                                 : writeGlb(arguments.output, prepared.mesh, prepared.glb);
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
    if (endingOf(arguments.input).empty()) // rather a misspelt command than a mesh
        if (const auto exists = inputExists(arguments); !exists) return exists.error();
    if (const auto can = checkOutput(arguments.report, {}); !can) return can.error();
    if (arguments.dryRun) return {};
    if (arguments.output.empty()) return usageError(8040, "where should the prepared mesh go?", "-o OUT.glb or OUT.ply, or --dry-run");
    if (const std::string ending = endingOf(arguments.output); ending != ".glb" && ending != ".ply")
        return usageError(8042, fmt::format("cannot write a mesh as '{}'", arguments.output), "name it OUT.glb or OUT.ply");
    return checkOutput(arguments.output, {});
}

/// What a PLY file has no place for.
void warnOfPly(const prep::Prepared& prepared) {
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
    if (lost.empty()) return;
    warn({{.severity = Severity::Warning,
           .code = 5331,
           .at = {.byte = {}},
           .text = fmt::format("a PLY file keeps none of {}", lost),
           .hint = "write a glb to keep them",
           .sourceLine = {}}});
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
    if (endingOf(arguments.output) == ".ply") arguments.options.levels = 1; // it holds the full mesh only
    arguments.options.guessUnit = true;
    arguments.options.turnUp = arguments.up.empty() ? endingOf(arguments.input) == ".stl" : arguments.up == "z";
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
    if (endingOf(arguments.output) == ".ply") warnOfPly(*prepared);
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

} // namespace

namespace {

void addReading(CLI::App& command, Arguments& arguments) {
    ReadOptions& read = arguments.options.read;
    command.add_option("--unit-mm", read.unitMm, "Millimetres per unit of the file; default: 1000 for glTF, else 1, or what is likely");
    command
        .add_option("--up", arguments.up,
                    "Which axis of the file points up, y or z; default: z of STL files, else y. Of what is written it is y")
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
    command.add_flag("--unwrap", options.unwrap, "Make texture coordinates: charts without overlap; those of the file and its textures go");
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
    command.add_option("input", arguments->input, "Mesh to prepare: PLY, OBJ, STL, OFF, glb or glTF");
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
