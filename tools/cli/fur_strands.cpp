#include "tools/cli/fur_strands.h"

#include "host/image/dds.h"
#include "host/run/parts.h"
#include "host/support/file.h"
#include "host/support/text.h"
#include "meshprep/assets/generators.h"
#include "meshprep/assets/names.h"
#include "meshprep/assets/strands.h"
#include "meshprep/fur/ribbons/ribbons.h"
#include "meshprep/fur/roots/head_hair.h"
#include "meshprep/fur/roots/vertex_maps.h"
#include "tools/cli/command_line.h"
#include "tools/cli/fur_roots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct StrandArguments {
    RootArguments roots;
    RibbonOptions ribbons;
    std::string given; // roots made before
    std::string output = "out/fur/strands.glb";
    std::string flowMap, colorMap, regionMap;
    std::string flowAttribute, colorAttribute, regionAttribute;
    bool json = false;
};

Result<void> loadMap(const std::string& path, std::optional<FurMap>& map) {
    if (path.empty()) return {};
    auto loaded = FurMap::load(path);
    if (!loaded) return loaded.error();
    map = *std::move(loaded);
    return {};
}

Result<void> readAttribute(const StrandArguments& arguments, const Mesh& mesh, const std::string& name, std::optional<FurMap>& map,
                           Result<FurMap> (*read)(const fs::path&, const std::string&, const Mesh&)) {
    if (name.empty()) return {};
    auto values = read(arguments.roots.input, name, mesh);
    if (!values) return values.error();
    map = *std::move(values);
    return {};
}

Result<void> readMaps(StrandArguments& arguments, const Mesh& mesh) {
    RibbonOptions& ribbons = arguments.ribbons;
    if (const auto read = loadMap(arguments.flowMap, ribbons.flowMap); !read) return read;
    if (const auto read = loadMap(arguments.colorMap, ribbons.colorMap); !read) return read;
    if (const auto read = loadMap(arguments.regionMap, ribbons.regionMap); !read) return read;
    ribbons.encoded = !arguments.colorMap.empty() && toLower(fs::path(arguments.colorMap).extension().string()) != ".exr";
    if (const auto read = readAttribute(arguments, mesh, arguments.flowAttribute, ribbons.flowMap, readVertexDirections); !read)
        return read;
    if (const auto read = readAttribute(arguments, mesh, arguments.colorAttribute, ribbons.colorMap, readVertexColors); !read) return read;
    return readAttribute(arguments, mesh, arguments.regionAttribute, ribbons.regionMap, readVertexShares);
}

/// A mesh and the texture that its strands name.
struct Grown {
    Mesh mesh;
    Image roots;
    RibbonFigures figures;
};

Result<Grown> grow(StrandArguments& arguments, Progress& progress) {
    Grown grown;
    if (arguments.given.empty()) {
        auto built = buildRoots(arguments.roots, progress);
        if (!built) return built.error();
        grown.mesh = std::move(built->mesh);
        grown.roots = std::move(built->texture.image);
    } else {
        progress.say("reading the mesh");
        auto mesh = loadMesh(arguments.roots.input, arguments.roots.mesh);
        if (!mesh) return mesh.error();
        grown.mesh = *std::move(mesh);
        auto roots = assets::loadRoots(arguments.given, grown.mesh);
        if (!roots) return roots.error();
        grown.roots = *std::move(roots);
    }
    if (const auto read = readMaps(arguments, grown.mesh); !read) return read.error();
    progress.say("growing strands");
    arguments.ribbons.threads = arguments.roots.roots.threads;
    const auto figures = addRibbons(grown.mesh, grown.roots, arguments.ribbons);
    if (!figures) return figures.error();
    grown.figures = *figures;
    return grown;
}

Json toJson(const RibbonFigures& figures) {
    return {{"strands", figures.strands},   {"vertices", figures.vertices}, {"triangles", figures.triangles},
            {"clusters", figures.clusters}, {"cone", figures.widestCone},   {"comb", {figures.comb.x, figures.comb.y, figures.comb.z}},
            {"seconds", figures.seconds}};
}

Result<void> checkInputs(const StrandArguments& arguments) {
    if (const auto can = checkOutput(arguments.output, {".glb"}); !can) return can.error();
    if (const auto exist = checkRootInputs(arguments.roots); !exist) return exist.error();
    for (const std::string& file : {arguments.given, arguments.flowMap, arguments.colorMap, arguments.regionMap})
        if (!file.empty())
            if (const auto exists = assets::fileExists(file, file == arguments.given ? "--roots" : "the map"); !exists)
                return exists.error();
    return {};
}

int growFile(StrandArguments& arguments) {
    if (const auto fine = checkInputs(arguments); !fine) return fail(fine.error(), arguments.json);
    Progress progress;
    const auto grown = grow(arguments, progress);
    if (!grown) return fail(grown.error(), arguments.json);
    progress.say("writing");
    std::vector<std::string> files{arguments.output};
    if (const auto written = writeGlb(arguments.output, grown->mesh); !written) return fail(written.error(), arguments.json);
    if (arguments.given.empty()) {
        files.push_back(fs::path(arguments.output).replace_extension(".dds").string());
        const DdsTexture dds{.format = DdsFormat::Rgba32F, .images = {grown->roots}};
        if (const auto written = writeDds(files.back(), dds); !written) return fail(written.error(), arguments.json);
    }
    progress.clear();
    warn(grown->mesh.warnings);
    const RibbonFigures& f = grown->figures;
    if (arguments.json) {
        Json json = toJson(f);
        json["files"] = files;
        print(json);
        return 0;
    }
    fmt::print("{} strands, {} vertices, {} triangles, in {} clusters whose normals differ by {:.0f} degrees (median)\n", f.strands,
               f.vertices, f.triangles, f.clusters, f.widestCone);
    fmt::print("combed to ({:.2f}, {:.2f}, {:.2f}); {:.3f} s\n", f.comb.x, f.comb.y, f.comb.z, f.seconds);
    for (const std::string& file : files)
        fmt::print("wrote {}\n", file);
    return 0;
}

/// "x y z".
void addVector(CLI::App& command, const char* name, std::function<void(const glm::dvec3&)> take, const char* help) {
    command
        .add_option_function<std::vector<double>>(
            name,
            [take = std::move(take)](const std::vector<double>& v) {
                take({v[0], v[1], v[2]});
            },
            help)
        ->expected(3);
}

void addShape(CLI::App& command, StrandArguments& arguments) {
    command.add_option("--segments", arguments.ribbons.segments, "Segments of a ribbon")->capture_default_str();
    command.add_option("--cluster", arguments.ribbons.cluster, "Roots of a cluster")->capture_default_str();
    addVector(
        command, "--flow", [&arguments](const glm::dvec3& v) { arguments.ribbons.comb = v; },
        "Direction in which the coat is combed, x y z; default: from the mesh's shape, from the head to the tail and down");
    addVector(
        command, "--down", [&arguments](const glm::dvec3& v) { arguments.ribbons.down = v; }, "Where down is for that, x y z");
    auto* flow = command.add_option("--flow-map", arguments.flowMap,
                                    "Picture (tangent space) or cube map (mesh space) in place of it: direction, 0.5 is 0");
    auto* color = command.add_option("--color-map", arguments.colorMap, "Picture or cube map: albedo of the strands, sRGB (EXR: linear)");
    auto* region = command.add_option("--region-map", arguments.regionMap,
                                      "Picture or cube map: 0 long fur, 1 short; default: short where the body is thin");
    command.add_option("--flow-attribute", arguments.flowAttribute, "Three properties of a PLY file's vertices, X,Y,Z: direction")
        ->excludes(flow);
    command
        .add_option("--color-attribute", arguments.colorAttribute, "Three properties of a PLY file's vertices, as red,green,blue: albedo")
        ->excludes(color);
    command.add_option("--region-attribute", arguments.regionAttribute, "Property of a PLY file's vertices: 0 long fur, 1 short")
        ->excludes(region);
}

} // namespace

void addFurStrands(CLI::App& fur, Action& action) {
    auto arguments = std::make_shared<StrandArguments>();
    CLI::App* command = fur.add_subcommand("strands", "Grow strands on a mesh as ribbons, a part of it (docs/design/fur.md)");
    command->add_option("mesh", arguments->roots.input, "Mesh, as the effect will draw it")->required();
    command->add_option("-o,--output", arguments->output, "glb to write; roots that are made stand beside it as DDS")
        ->capture_default_str();
    command->add_option("--roots", arguments->given, "Roots of tegument fur roots for this mesh; default: made, with these options");
    addRootOptions(*command, arguments->roots);
    addShape(*command, *arguments);
    command->add_flag("--json", arguments->json, "Print JSON");
    addExamples(*command, {{"fur strands bunny.glb -o out/fur/bunny_strands.glb", "roots and ribbons"},
                           {"fur strands bunny.glb --roots out/fur/bunny_roots.dds --flow 1 -0.5 0", "on roots that are there, combed"},
                           {"fur strands fox.ply --color-attribute red,green,blue", "in the colours of a scan"}});
    command->callback([arguments, &action] { action = [arguments] { return growFile(*arguments); }; });
}

} // namespace tegument::app
