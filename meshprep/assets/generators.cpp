#include "meshprep/assets/generators.h"

#include "host/image/dds.h"
#include "host/mesh/mesh.h"
#include "host/support/cache.h"
#include "host/support/file.h"
#include "meshprep/assets/cached_links.h"
#include "meshprep/assets/strand_passes.h"
#include "meshprep/fur/cube_texture.h"
#include "meshprep/fur/fur_map.h"
#include "meshprep/fur/ribbons/ribbons.h"
#include "meshprep/fur/roots/head_hair.h"
#include "meshprep/fur/roots/root_texture.h"
#include "meshprep/light/environment.h"
#include "meshprep/light/occlusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

namespace tegument::assets {

namespace fs = std::filesystem;

namespace {

/// What the annotation Generator calls them.
inline constexpr const char* kStudioGenerator = "studio";
inline constexpr const char* kSkyGenerator = "sky";
inline constexpr const char* kOcclusionGenerator = "occlusion";

/// Part of the name in the cache: a change of what is made takes another number.
constexpr int kEnvironmentVersion = 1;

/// A default environment, by one of the first two names: a file in the cache, made where it is not there. `say` is told.
Result<fs::path> cachedEnvironment(const std::string& generator, const Say& say) {
    const auto kind = generator == kSkyGenerator ? DefaultEnvironment::Sky : DefaultEnvironment::Studio;
    const auto make = [&](const fs::path& file) -> Result<void> {
        const auto texture = makeEnvironment(defaultEnvironment(kind), generator);
        if (!texture) return texture.error();
        return writeDds(file, *texture);
    };
    return cachedDds("light", fmt::format("{}_{}", generator, kEnvironmentVersion), "the " + generator, say, make);
}

/// The mesh's own, by its shape and texture coordinates.
Result<fs::path> cachedOcclusion(const Mesh& mesh, const Say& say) {
    const CacheKey key =
        CacheKey(fmt::format("occlusion {}", kOcclusionVersion)).add(mesh.positions).add(mesh.normals).add(mesh.uvs).add(mesh.indices);
    const auto make = [&](const fs::path& file) -> Result<void> {
        const auto occlusion = bakeOcclusion(mesh);
        if (!occlusion) return occlusion.error();
        return writeDds(file, makeDds(occlusion->map, DdsFormat::Rgba16F, false));
    };
    return cachedDds("light", "occlusion_" + key.text(), "occlusion for " + mesh.name, say, make);
}

constexpr const char* kCubeMap = "fur cube map";
constexpr const char* kSphereMap = "fur sphere map";

/// Cones that stand 3 texels apart, as ./bootstrap demo makes them.
constexpr int kMapSide = 2048;
constexpr FurOptions kMapOptions{.density = 0.05, .spacing = 2.8, .radius = 3.4, .shortest = 0.45, .taper = true};
/// What `tegument fur texture` prints for these: tests/cli/own_mesh_test.cpp.
const std::map<std::string, std::vector<double>> kMapParameters = {
    {"gFurTaper", {1}}, {"gFurDeviation", {0.194}}, {"gFurGrain", {0.00473}}};

bool growsRoots(const std::string& generator) {
    return generator == kRootsGenerator || generator == kHairGenerator;
}

/// Part of every name in the cache: a change of what is made takes another number.
constexpr int kVersion = 1;

Result<DdsTexture> drawMap(const std::string& generator) {
    const int side = generator == kCubeMap ? cubeMapSide(kMapSide) : kMapSide;
    const auto strands = strandsOnSphere(generator == kCubeMap ? cubeMapTexels(side) : sphereMapTexels(side), kMapOptions);
    if (!strands) return strands.error();
    if (generator == kCubeMap) return cubeTexture(drawCubeMap(*strands, side, kMapOptions), DdsFormat::Rgba8);
    return makeDds(drawSphereMap(*strands, side, kMapOptions), DdsFormat::Rgba8, true);
}

Result<RootOptions> hairOptions(const Mesh& mesh) {
    auto hair = hairOfHead(mesh);
    if (!hair)
        return inputError(4054, {.file = mesh.name}, "no hair is known for this mesh: it has no part 'eyes' to measure from",
                          "take the default head, or give roots: tegument fur roots MESH --density-map MAP -o FILE.dds");
    constexpr std::size_t kLocks = 150'000; // if all of the head were scalp; about a third of them is left
    return RootOptions{
        .count = kLocks, .shortest = 0.75, .densityMap = FurMap(std::move(hair->density)), .lengthMap = FurMap(std::move(hair->length))};
}

Result<DdsTexture> drawRoots(const std::string& generator, const Mesh& mesh) {
    Result<RootOptions> options = RootOptions{.shortest = 0.5}; // lengths as of the Bunny in ./bootstrap demo
    if (generator == kHairGenerator) options = hairOptions(mesh);
    if (!options) return options.error();
    auto roots = makeRoots(mesh, *options);
    if (!roots) return roots.error();
    auto texture = buildRootTexture(*roots);
    if (!texture) return texture.error();
    return DdsTexture{.format = DdsFormat::Rgba32F, .images = {std::move(texture->image)}};
}

Result<fs::path> make(const std::string& generator, const Mesh& mesh, const Say& say) {
    if (generator == kSkinLinksGenerator) return cachedSkinLinks(mesh, say);
    if (generator == kStudioGenerator || generator == kSkyGenerator) return cachedEnvironment(generator, say);
    if (generator == kOcclusionGenerator) return cachedOcclusion(mesh, say);
    const bool roots = growsRoots(generator);
    if (roots && hasRibbons(mesh))
        return inputError(4061, {.file = mesh.name}, "the mesh has strands, and nothing names the roots that they stand on",
                          "tegument fur strands has written them beside the mesh: give that file");
    if (!roots && generator != kCubeMap && generator != kSphereMap)
        return inputError(4054, {}, fmt::format("nothing makes a '{}'", generator),
                          fmt::format("the annotation Generator knows \"{}\", \"{}\", \"{}\", \"{}\", \"{}\", \"{}\" and \"{}\"", kCubeMap,
                                      kSphereMap, kRootsGenerator, kSkinLinksGenerator, kStudioGenerator, kSkyGenerator,
                                      kOcclusionGenerator));
    std::string name = fmt::format("{}_{}", generator == kCubeMap ? "cube" : "sphere", kVersion);
    if (roots)
        name = (generator == kHairGenerator ? "hair_" : "roots_") +
               CacheKey(fmt::format("roots {}", kVersion)).add(mesh.positions).add(mesh.normals).add(mesh.indices).text();
    const auto write = [&](const fs::path& file) -> Result<void> {
        const auto texture = roots ? drawRoots(generator, mesh) : drawMap(generator);
        if (!texture) return texture.error();
        return writeDds(file, *texture);
    };
    return cachedDds("fur", name, roots ? fmt::format("{} for {}", generator, mesh.name) : generator, say, write);
}

/// Files that do not hold roots are left to who loads them.
Result<void> check(const std::string& generator, const fs::path& file, const Mesh& mesh) {
    if (generator == kSkinLinksGenerator) return checkSkinLinks(file, mesh);
    if (!growsRoots(generator)) return {};
    const auto texture = loadDds(file);
    if (!texture || texture->isCube()) return {};
    if (const auto other = hasRibbons(mesh) ? whyNotItsRoots(mesh, texture->at(0, 0)) : std::nullopt)
        return inputError(4061, {.file = file.string()}, fmt::format("the strands of {} were made from other roots: {}", mesh.name, *other),
                          "give the roots that they were made from, or make both again: tegument fur strands MESH");
    const auto figures = figuresIn(texture->at(0, 0));
    if (!figures) return {};
    const auto why = whyNotSame(*figures, surfaceFigures(mesh));
    if (!why) return {};
    return inputError(4055, {.file = file.string()}, fmt::format("these roots were made for another mesh than {}: {}", mesh.name, *why),
                      "leave them out, and they are made; or: tegument fur roots MESH -o FILE.dds");
}

bool named(const std::map<std::string, std::string>& textures, const std::string& name) {
    return textures.contains(name);
}

} // namespace

Result<fs::path> cachedDds(const std::string& folder, const std::string& name, const std::string& what, const Say& say,
                           const std::function<Result<void>(const fs::path&)>& make) {
    const fs::path file = cacheFolder() / folder / "made" / (name + ".dds");
    if (isWholeDds(file)) return file;
    const auto start = std::chrono::steady_clock::now();
    if (const auto made = make(file); !made) return made.error();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (say) say(fmt::format("made {} in {:.1f} s: {}", what, seconds, file.string()));
    return file;
}

MeshAssets meshAssets(Say say) {
    const auto strands = std::make_shared<StrandPasses>();
    return {.make = [say = std::move(say)](const std::string& generator, const Mesh& mesh) { return make(generator, mesh, say); },
            .check = check,
            .list = [strands](const PassRequest& request) { return strands->list(request); },
            .fits = checkStrandRows};
}

void setFurMapParameters(const Effect& effect, const RunOptions& options, Scene& scene) {
    const auto isMap = [&](const Parameter& parameter) {
        const auto generator = parameter.annotations.string("Generator");
        return generator && (*generator == kCubeMap || *generator == kSphereMap);
    };
    const auto apply = [&](Workspace& workspace) {
        const bool own = std::ranges::any_of(effect.parameters, [&](const Parameter& parameter) {
            return isMap(parameter) && (named(options.textures, parameter.name) || named(workspace.textures, parameter.name));
        });
        if (own || std::ranges::none_of(effect.parameters, isMap)) return;
        workspace.parameters.insert(kMapParameters.begin(), kMapParameters.end());
    };
    apply(scene.workspace);
    for (RunObject& object : scene.objects)
        apply(object.workspace);
}

} // namespace tegument::assets
