#include "meshprep/assets/strands.h"

#include "host/image/dds.h"
#include "host/run/parts.h"
#include "host/support/cache.h"
#include "meshprep/fur/ribbons/pose.h"
#include "meshprep/fur/ribbons/ribbons.h"
#include "meshprep/fur/roots/head_hair.h"
#include "meshprep/fur/roots/root_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::assets {

namespace fs = std::filesystem;

namespace {

constexpr const char* kRoots = "gFurRootsMap";
constexpr double kReachInLengths = 4; // of the coat, that strands may be away from their roots: the effects' ReachScale
constexpr double kCurveSegment = 1.5; // pixels of a quarter of a curve: 6 of its segments
constexpr const char* kPose = "gFurPoseMap";
constexpr const char* kPoseBefore = "gFurPoseBeforeMap";

Result<Image> loadRootTexture(const std::string& file) {
    auto texture = loadDds(file);
    if (!texture) return texture.error();
    return texture->images.front();
}

Error ofAnotherMesh(const std::string& file, const Mesh& mesh, const std::string& why) {
    return inputError(4055, {.file = file}, fmt::format("these roots were made for another mesh than {}: {}", mesh.name, why),
                      "leave them out, and they are made; or: tegument fur roots MESH -o FILE.dds");
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
Result<fs::path> rootsFile(const Parameter& roots, const RunOptions& options, const Workspace& workspace, const Mesh& mesh) {
    if (const auto set = options.textures.find(roots.name); set != options.textures.end()) return fs::path(set->second);
    if (const auto named = workspace.textures.find(roots.name); named != workspace.textures.end())
        return workspace.file.parent_path() / named->second;
    return options.assets.make(generatorOf(roots), mesh);
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

/// What the effect's parameters are where strands are curves, unless they are given: lengths, widths and colours are the curves', and every
/// root has one strand.
void suitCurves(const RootHeader& curves, const Effect& effect, const RunOptions& options, Scene& scene) {
    const double radius = curves.ballRadius;
    const std::pair<const char*, double> values[] = {{"gFurLength", curves.farthest / (kReachInLengths * radius)},
                                                     {"gFurRadius", curves.widest * std::sqrt(curves.density)},
                                                     {"gCoatRadius", curves.widest / radius},
                                                     {"gCoatChildren", 1},
                                                     {"gCoatShadowStrands", 1},
                                                     {"gCoatUnderfur", 0},
                                                     {"gCoatUndercoat", 0},
                                                     {"gCoatGuard", 0},
                                                     {"gCoatPainted", curves.painted ? 1 : 0},
                                                     {"gCoatSegment", kCurveSegment},
                                                     {"gRibbonSegment", kCurveSegment}};
    for (const auto& [name, value] : values) {
        if (!effect.findParameter(name) || options.parameters.contains(name)) continue;
        if (scene.isOwn)
            scene.workspace.parameters[name] = {value};
        else
            scene.workspace.parameters.try_emplace(name, std::vector<double>{value});
    }
}

/// Into the cache: a texture has a name.
Result<void> givePose(const char* parameter, Image image, Scene& scene) {
    const std::string name = "pose_" + CacheKey("pose 1").add(image.pixels).text();
    const auto file = cachedDds("fur", name, {}, {}, [&](const fs::path& made) {
        return writeDds(made, {.format = DdsFormat::Rgba32F, .images = {std::move(image)}});
    });
    if (!file) return file.error();
    scene.workspace.textures[parameter] = fs::absolute(*file).string();
    return {};
}

} // namespace

Result<Image> loadRoots(const std::string& file, const Mesh& mesh) {
    auto texture = loadDds(file);
    if (!texture) return texture.error();
    Image roots = texture->images.front();
    const auto figures = texture->isCube() ? std::nullopt : figuresIn(roots);
    const auto why = figures ? whyNotSame(*figures, surfaceFigures(mesh)) : std::nullopt;
    if (why) return ofAnotherMesh(file, mesh, *why);
    return roots;
}

std::optional<RootHeader> curvesBeside(const fs::path& meshFile) {
    const fs::path beside = fs::path(meshFile).replace_extension(".dds");
    if (std::error_code code; meshFile.extension() != ".glb" || !fs::is_regular_file(beside, code)) return std::nullopt;
    const auto texture = loadDds(beside);
    const auto header = texture ? rootHeader(texture->images.front()) : std::nullopt;
    return header && header->curvePoints > 0 ? header : std::nullopt;
}

Result<void> growStrands(const Effect& effect, const RunOptions& options, Scene& scene, const fs::path& meshFile) {
    const Parameter* roots = rootsOf(effect);
    if (!roots || (!run::drawsPart(effect, kStrandsPart) && !run::drawsPart(effect, kUnderfurPart))) return {};
    for (Mesh& mesh : scene.meshes) {
        const auto object = std::ranges::find_if(scene.objects, [&](const RunObject& own) { return own.mesh == &mesh; });
        const Workspace& workspace = object == scene.objects.end() ? scene.workspace : object->workspace;
        if (hasRibbons(mesh)) {
            const fs::path beside = fs::path(meshFile).replace_extension(".dds");
            if (std::error_code code; !workspace.textures.contains(roots->name) && fs::is_regular_file(beside, code))
                nameRoots(scene, mesh, roots->name, beside);
            if (const auto curves = curvesBeside(meshFile)) suitCurves(*curves, effect, options, scene);
            continue;
        }
        const auto file = rootsFile(*roots, options, workspace, mesh);
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

Result<Mesh> readPose(const std::string& file, const Mesh& rest, MeshOptions load) {
    load.unitMm = rest.unitMm;
    load.guessUnit = false;
    load.expectHead = false;
    auto posed = loadMesh(file, load);
    if (!posed) return posed;
    for (glm::vec3& position : posed->positions)
        position += glm::vec3(posed->origin - rest.origin);
    computeBounds(*posed);
    if (sameTriangles(rest, *posed)) return posed;
    return inputError(8048, {.file = file},
                      fmt::format("this is no pose of {}: {} vertices and {} triangles, or in another order than its {} and {}", rest.name,
                                  posed->positions.size(), posed->indices.size() / 3, rest.positions.size(), rest.indices.size() / 3),
                      "move the vertices of that file, and neither add nor merge any");
}

Result<void> poseStrands(const Effect& effect, const RunOptions& options, Scene& scene) {
    if (!scene.pose) return {};
    if (!effect.findParameter(kPose))
        return usageError(8047, fmt::format("--pose: {} draws no strands that bend", effect.file.string()),
                          "give the bent mesh itself: --mesh FILE; FurCoat takes --pose");
    const auto set = options.textures.find(kRoots);
    const fs::path named = scene.workspace.file.parent_path() / scene.workspace.textures[kRoots];
    const auto roots = loadRootTexture(set != options.textures.end() ? set->second : named.string());
    if (!roots) return roots.error();
    Mesh& mesh = scene.meshes.front();
    const Mesh skin = skinOf(mesh, *scene.pose);
    const auto seats = seatsOfRoots(skin, *roots);
    if (!seats) return seats.error();
    Image pose = poseTexture(*seats, skin, *scene.pose, *roots);
    if (effect.findParameter(kPoseBefore)) {
        const Mesh& before = scene.poseBefore ? *scene.poseBefore : *scene.pose;
        if (const auto given = givePose(kPoseBefore, poseTexture(*seats, skin, before, *roots), scene); !given) return given;
    }
    applyPose(mesh, *scene.pose, pose);
    return givePose(kPose, std::move(pose), scene);
}

} // namespace tegument::assets
