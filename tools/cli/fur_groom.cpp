#include "tools/cli/fur_groom.h"

#include "host/image/dds.h"
#include "meshprep/assets/names.h"
#include "meshprep/fur/ribbons/ribbons.h"
#include "meshprep/groom/bind.h"
#include "meshprep/groom/groom_file.h"
#include "meshprep/write/write_mesh.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* kSplineNames[] = {"linear", "bezier", "bspline", "catmull-rom"};

struct GroomArguments {
    std::string input;
    GroomOptions read;
    GroomOptions write; // of export
    std::string output;
    std::string mesh;
    MeshOptions skin;
    BindOptions bind;
    double share = 1;
    double length = 0.06; // of export: of a coat
    bool json = false;
};

/// What stands beside a mesh with strands.
fs::path rootsBeside(const fs::path& mesh) {
    return fs::path(mesh).replace_extension(".dds");
}

Result<Groom> fewer(Groom groom, double share) {
    if (!(share > 0 && share <= 1))
        return usageError(8052, fmt::format("--share {:g} is no share of the strands", share), "more than 0, at most 1");
    if (share == 1) return groom;
    return strandsOf(groom, [share](std::size_t i) { // as evenly along the file as whole strands allow
        return std::floor(share * static_cast<double>(i + 1)) > std::floor(share * static_cast<double>(i));
    });
}

/// A file of curves, or the strands of a mesh that `fur strands` or `fur import` has written.
Result<Groom> load(const GroomArguments& arguments) {
    if (const auto exists = assets::fileExists(arguments.input, "the groom"); !exists) return exists.error();
    if (std::error_code code; fs::path(arguments.input).extension() == ".glb" && fs::is_regular_file(rootsBeside(arguments.input), code)) {
        const auto mesh = loadMesh(arguments.input, arguments.skin);
        if (mesh && hasRibbons(*mesh)) {
            const auto roots = loadDds(rootsBeside(arguments.input));
            if (!roots) return roots.error();
            auto groom = groomOfRoots(*mesh, roots->images.front(), arguments.length);
            return groom ? fewer(*std::move(groom), arguments.share) : groom;
        }
    }
    auto groom = readGroom(arguments.input, arguments.read);
    return groom ? fewer(*std::move(groom), arguments.share) : groom;
}

std::vector<std::string> attributesOf(const Groom& groom) {
    std::vector<std::string> names;
    const auto add = [&](bool there, const char* name) {
        if (there) names.emplace_back(name);
    };
    add(!groom.widths.empty(), "widths");
    add(!groom.colors.empty(), "colours");
    add(!groom.rootUvs.empty(), "root UVs");
    add(!groom.ids.empty(), "ids");
    add(!groom.guides.empty(), "guides");
    add(!groom.clumps.empty(), "clumps");
    return names;
}

Json numbers(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

int inform(const GroomArguments& arguments) {
    const auto groom = load(arguments);
    if (!groom) return fail(groom.error(), arguments.json);
    const GroomFigures f = figuresOf(evaluated(*groom));
    const std::vector<std::string> attributes = attributesOf(*groom);
    const char* spline = kSplineNames[static_cast<std::size_t>(groom->spline)];
    if (arguments.json) {
        print({{"strands", f.strands},
               {"guides", f.guides},
               {"points", groom->points.size()},
               {"spline", spline},
               {"points_of_a_strand", {f.fewest, f.most}},
               {"length_mm", numbers(f.length)},
               {"width_mm", numbers(f.width)},
               {"low_mm", numbers(f.low)},
               {"high_mm", numbers(f.high)},
               {"unit_mm", groom->unitMm},
               {"up", groom->zIsUp ? "z" : "y"},
               {"holds", attributes},
               {"diagnostics", toJson(groom->warnings)}});
        return 0;
    }
    warn(groom->warnings);
    fmt::print("{}, {} of them guides; {}, {}\n", counted(f.strands, "strand"), f.guides, counted(groom->points.size(), "control point"),
               spline);
    fmt::print("as chains: {} to {} points a strand\n", f.fewest, f.most);
    fmt::print("length {:.4g} to {:.4g} mm, median {:.4g} mm\n", f.length.x, f.length.z, f.length.y);
    if (groom->widths.empty())
        fmt::print("no widths: {} mm is taken\n", kUsualWidth);
    else
        fmt::print("width {:.3g} to {:.3g} mm, median {:.3g} mm\n", f.width.x, f.width.z, f.width.y);
    fmt::print("from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) mm: one unit is {:g} mm, {} is up\n", f.low.x, f.low.y, f.low.z,
               f.high.x, f.high.y, f.high.z, groom->unitMm, groom->zIsUp ? "z" : "y");
    fmt::print("holds {}\n", attributes.empty() ? "places only" : fmt::format("{}", fmt::join(attributes, ", ")));
    return 0;
}

void printBound(const BoundFigures& f) {
    fmt::print("{} of {}\n", counted(f.strands, "strand"), counted(f.points, "point"));
    if (f.guides > 0) fmt::print("{} guides are not drawn\n", f.guides);
    if (f.madeSkin)
        fmt::print("no --mesh: strands alone, and nothing behind them\n");
    else
        fmt::print("roots were moved by {:.3g} mm (median), and are within {:.2g} mm of the skin\n", f.moved, f.error);
    if (f.off > 0) fmt::print("{} strands stand off the skin, and stay there: say --unit-mm, --up or --snap if they should not\n", f.off);
    if (f.resampled > 0)
        fmt::print("{} strands had more points; what is left of them is within {:.3g} mm\n", f.resampled, f.resampledError);
}

int import(GroomArguments& arguments) {
    const fs::path beside = rootsBeside(arguments.output);
    if (const auto can = checkOutput(arguments.output, {".glb"}, "tegument fur export writes other formats"); !can)
        return fail(can.error(), arguments.json);
    if (const auto can = checkOutput(beside.string(), {}); !can) return fail(can.error(), arguments.json);
    Progress progress;
    progress.say("reading the groom");
    auto groom = load(arguments);
    if (!groom) return fail(groom.error(), arguments.json);
    Mesh mesh;
    if (!arguments.mesh.empty()) {
        if (const auto exists = assets::fileExists(arguments.mesh, "--mesh"); !exists) return fail(exists.error(), arguments.json);
        auto skin = loadMesh(arguments.mesh, arguments.skin);
        if (!skin) return fail(skin.error(), arguments.json);
        mesh = *std::move(skin);
    }
    progress.say("binding strands to the skin");
    std::vector<Diagnostic> warnings = groom->warnings;
    BoundFigures f;
    auto roots = bindGroom(mesh, *std::move(groom), arguments.bind, f);
    if (!roots) return fail(roots.error(), arguments.json);
    progress.say("writing");
    if (const auto written = writeGlb(arguments.output, mesh); !written) return fail(written.error(), arguments.json);
    if (const auto written = writeDds(beside, {.format = DdsFormat::Rgba32F, .images = {*std::move(roots)}}); !written)
        return fail(written.error(), arguments.json);
    progress.clear();
    warnings.insert(warnings.end(), mesh.warnings.begin(), mesh.warnings.end());
    if (arguments.json) {
        print({{"strands", f.strands},
               {"points_of_a_strand", f.points},
               {"guides", f.guides},
               {"off_the_skin", f.off},
               {"moved_mm", f.moved},
               {"error_mm", f.error},
               {"resampled", f.resampled},
               {"resampled_error_mm", f.resampledError},
               {"files", {arguments.output, beside.string()}},
               {"diagnostics", toJson(warnings)}});
        return 0;
    }
    warn(warnings);
    printBound(f);
    fmt::print("wrote {}\nwrote {}\ntegument render FurCoat --mesh {} -o groom.png draws it\n", arguments.output, beside.string(),
               arguments.output);
    return 0;
}

int exportGroom(const GroomArguments& arguments) {
    if (const auto can = checkOutput(arguments.output, groomEndings(), "tegument fur import writes what this program draws"); !can)
        return fail(can.error(), arguments.json);
    Progress progress;
    progress.say("reading the groom");
    const auto groom = load(arguments);
    if (!groom) return fail(groom.error(), arguments.json);
    progress.say("writing");
    const auto lost = writeGroom(arguments.output, *groom, arguments.write);
    if (!lost) return fail(lost.error(), arguments.json);
    progress.clear();
    std::vector<Diagnostic> warnings = groom->warnings;
    warnings.insert(warnings.end(), lost->begin(), lost->end());
    if (arguments.json) {
        print({{"strands", groom->strands()},
               {"points", groom->points.size()},
               {"files", {arguments.output}},
               {"diagnostics", toJson(warnings)}});
        return 0;
    }
    warn(warnings);
    fmt::print("{}, {}\nwrote {}\n", counted(groom->strands(), "strand"), counted(groom->points.size(), "control point"), arguments.output);
    return 0;
}

void addUp(CLI::App& command, const char* name, GroomOptions& options, const char* help) {
    command
        .add_option_function<std::string>(
            name, [&options](const std::string& axis) { options.zIsUp = axis == "z"; }, help)
        ->transform(oneOf({"y", "z"}));
}

CLI::App* addCommand(CLI::App& fur, const char* name, const char* help, GroomArguments& arguments) {
    CLI::App* command = fur.add_subcommand(name, help);
    command
        ->add_option("groom", arguments.input,
                     ".abc, .usda, .hair, .tfx, .glb, .gltf, .ply, .obj with curves, or a .glb of fur strands or fur import")
        ->required();
    command->add_option(
        "--unit-mm", arguments.read.unitMm,
        "Millimetres in one unit of the groom; default: as a .usda says, .abc and .hair 10, .glb and .tfx 1000, .ply and .obj 1");
    addUp(*command, "--up", arguments.read, "Axis of the groom that is up, y or z; default: as a .usda says, else y");
    command->add_option("--frame", arguments.read.frame, "Which sample of an animated file")->capture_default_str();
    command->add_option("--share", arguments.share, "Share of the strands to take, 0 to 1")->capture_default_str();
    command->add_flag("--json", arguments.json, "Print JSON");
    return command;
}

} // namespace

void addFurGroom(CLI::App& fur, Action& action) {
    auto about = std::make_shared<GroomArguments>();
    CLI::App* info = addCommand(fur, "info", "Say what strands a file of curves holds", *about);
    addExamples(*info, {{"fur info hair.abc", "strands, lengths, widths, size in mm"},
                        {"fur info hair.hair --unit-mm 25.4 --up z", "in inches, z up"}});
    info->callback([about, &action] { action = [about] { return inform(*about); }; });

    auto in = std::make_shared<GroomArguments>();
    in->output = "out/fur/groom.glb";
    CLI::App* import_ =
        addCommand(fur, "import", "Bind the curves of another program to a mesh, to draw them (docs/design/grooms.md)", *in);
    import_->add_option("--mesh", in->mesh, "Skin on which the strands stand; default: none, strands alone");
    import_->add_option("--mesh-unit-mm", in->skin.unitMm, "Millimetres in one unit of the skin's file");
    import_->add_option("--snap", in->bind.snap, "Roots within so many mm are moved onto the skin; default: a fiftieth of its radius");
    import_->add_option("--width", in->bind.width, "Diameter of every strand, mm; default: as the groom says, else 0.08");
    import_->add_option("-o,--output", in->output, "glb to write: the skin with its strands; their curves stand beside it as DDS")
        ->capture_default_str();
    addExamples(*import_, {{"fur import hair.abc --mesh head.glb -o out/fur/hair.glb", "on a head"},
                           {"render FurCoat --mesh out/fur/hair.glb -o hair.png", "draw it"},
                           {"fur import hair.hair --up z", "without a skin"}});
    import_->callback([in, &action] { action = [in] { return import(*in); }; });

    auto out = std::make_shared<GroomArguments>();
    CLI::App* export_ = addCommand(fur, "export", "Write strands, ours or another program's, as curves that other programs open", *out);
    export_->add_option("-o,--output", out->output, "File to write: .abc, .usda, .hair, .tfx, .glb, .ply or .obj")->required();
    export_->add_option("--to-unit-mm", out->write.unitMm, "Millimetres in one unit of it; default: as --unit-mm's defaults");
    addUp(*export_, "--to-up", out->write, "Axis that is up in it, y or z; default: y");
    export_->add_option("--length", out->length, "Length of a coat that fur strands has grown, a share of the mesh's radius")
        ->capture_default_str();
    addExamples(*export_, {{"fur export out/fur/bunny_strands.glb -o bunny.abc", "a coat for Blender, Unreal or Houdini"},
                           {"fur export hair.tfx -o hair.usda", "from one program to another"}});
    export_->callback([out, &action] { action = [out] { return exportGroom(*out); }; });
}

} // namespace tegument::app
