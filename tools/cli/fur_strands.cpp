#include "tools/cli/fur_strands.h"

#include "host/image/dds.h"
#include "host/run/parts.h"
#include "host/support/file.h"
#include "host/support/text.h"
#include "meshprep/fur/ribbons/ribbons.h"
#include "meshprep/fur/roots/head_hair.h"
#include "meshprep/fur/roots/vertex_maps.h"
#include "tools/cli/command_line.h"
#include "tools/cli/fur_roots.h"
#include "tools/cli/fur_textures.h"
#include "tools/cli/names.h"

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

Error ofAnotherMesh(const std::string& file, const Mesh& mesh, const std::string& why) {
    return inputError(4055, {.file = file, .byte = {}}, fmt::format("these roots were made for another mesh than {}: {}", mesh.name, why),
                      "leave them out, and they are made; or: tegument fur roots MESH -o FILE.dds");
}

Result<Image> loadRoots(const std::string& file, const Mesh& mesh) {
    auto texture = loadDds(file);
    if (!texture) return texture.error();
    Image roots = texture->images.front();
    const auto figures = texture->isCube() ? std::nullopt : figuresIn(roots);
    const auto why = figures ? whyNotSame(*figures, surfaceFigures(mesh)) : std::nullopt;
    if (why) return ofAnotherMesh(file, mesh, *why);
    return roots;
}

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
        auto roots = loadRoots(arguments.given, grown.mesh);
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
            if (const auto exists = fileExists(file, file == arguments.given ? "--roots" : "the map"); !exists) return exists.error();
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

std::string generatorOf(const Parameter& parameter) {
    return parameter.annotations.string("Generator").value_or("");
}

/// The texture that strands read: the one whose generator makes roots.
const Parameter* rootsOf(const Effect& effect) {
    const auto found = std::ranges::find_if(effect.parameters, [](const Parameter& parameter) {
        return generatorOf(parameter) == kRootsGenerator || generatorOf(parameter) == kHairGenerator;
    });
    return found == effect.parameters.end() ? nullptr : &*found;
}

/// The file that is named, relative to the workspace, or one that is made.
Result<fs::path> rootsFile(const Parameter& roots, const RunOptions& options, const Workspace& workspace, const MeshTextures& textures,
                           const Mesh& mesh) {
    if (const auto set = options.textures.find(roots.name); set != options.textures.end()) return fs::path(set->second);
    if (const auto named = workspace.textures.find(roots.name); named != workspace.textures.end())
        return workspace.file.parent_path() / named->second;
    return textures.make(generatorOf(roots), mesh);
}

/// Of ribbons that are grown here: what the parameter with the generator "fur strands segments" says.
RibbonOptions ribbonsFor(const Effect& effect, const RunOptions& options, const Workspace& workspace) {
    RibbonOptions ribbons;
    for (const Parameter& parameter : effect.parameters) {
        if (parameter.annotations.string("Generator") != "fur strands segments") continue;
        const auto* value = parameter.defaultValue ? std::get_if<std::vector<double>>(&*parameter.defaultValue) : nullptr;
        if (const auto given = workspace.parameters.find(parameter.name); given != workspace.parameters.end()) value = &given->second;
        if (const auto given = options.parameters.find(parameter.name); given != options.parameters.end()) value = &given->second;
        if (value && value->size() == 1) ribbons.segments = static_cast<int>(std::lround(std::clamp(value->front(), 0.0, 1e6)));
    }
    return ribbons;
}

/// As a workspace's texture: for all objects that have this mesh.
void nameRoots(Scene& scene, const Mesh& mesh, const std::string& parameter, const fs::path& file) {
    const std::string path = fs::absolute(file).string();
    for (RunObject& own : scene.objects)
        if (own.mesh == &mesh) own.workspace.textures[parameter] = path;
    if (scene.objects.empty()) scene.workspace.textures[parameter] = path;
}

} // namespace

Result<void> growStrands(const Effect& effect, const RunOptions& options, Scene& scene, const fs::path& meshFile,
                         const std::function<void(const std::string&)>& say) {
    const Parameter* roots = rootsOf(effect);
    if (!roots || (!run::drawsPart(effect, kStrandsPart) && !run::drawsPart(effect, kUnderfurPart))) return {};
    const MeshTextures textures = furTextures(say);
    for (Mesh& mesh : scene.meshes) {
        const auto object = std::ranges::find_if(scene.objects, [&](const RunObject& own) { return own.mesh == &mesh; });
        const Workspace& workspace = object == scene.objects.end() ? scene.workspace : object->workspace;
        if (hasRibbons(mesh)) {
            const fs::path beside = fs::path(meshFile).replace_extension(".dds");
            if (std::error_code code; !workspace.textures.contains(roots->name) && fs::is_regular_file(beside, code))
                nameRoots(scene, mesh, roots->name, beside);
            continue;
        }
        const auto file = rootsFile(*roots, options, workspace, textures, mesh);
        if (!file) return file.error();
        const auto image = loadRoots(file->string(), mesh);
        if (!image) return image.error();
        RibbonOptions ribbons = ribbonsFor(effect, options, workspace);
        if (generatorOf(*roots) == kHairGenerator)
            if (auto hair = hairOfHead(mesh)) ribbons.flowMap = FurMap(std::move(hair->direction));
        const auto grown = addRibbons(mesh, *image, ribbons);
        if (!grown) return grown.error();
        nameRoots(scene, mesh, roots->name, *file); // none can be made any more for a mesh with strands
    }
    return {};
}

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
