#include "host/image/compare.h"
#include "host/image/dds.h"
#include "host/run/parts.h"
#include "host/support/temporary.h"
#include "lab/invariance/cases.h"
#include "lab/invariance/invariance.h"
#include "lab/invariance/painter.h"
#include "lab/verify/fur_scene.h"
#include "meshprep/fur/ribbons/ribbons.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace tegument {

namespace fs = std::filesystem;

namespace {

using namespace invariance;

constexpr double kSame = 1e-2; // of the mean: a pixel that differs by more is another
// Strands wide enough to be seen, in a coat that a small picture shows: an eighth of the radius long, three hundredths of it apart.
constexpr double kFurLength = 0.12;
constexpr double kFurSpacing = 0.03;
constexpr double kFurLayers = 6;
constexpr int kFurTexture = 64;

/// Files that go when this does.
class Textures {
public:
    explicit Textures(const fs::path& folder) : folder_(folder / fmt::format("tegument-invariance-{:08x}", std::random_device{}())) {}

    Result<void> add(Workspace& workspace, const std::string& parameter, const DdsTexture& texture) {
        if (workspace.textures.contains(parameter)) return {};
        const fs::path file = folder_.path() / (parameter + ".dds");
        if (const auto written = writeDds(file, texture); !written) return written;
        workspace.textures[parameter] = file.string();
        return {};
    }

private:
    Temporary folder_;
};

DdsTexture furCube() {
    DdsTexture cube{.format = DdsFormat::Rgba8, .faces = 6, .mips = 1};
    for (int face = 0; face < cube.faces; ++face)
        cube.images.push_back(verify::furPattern(kFurTexture, face));
    return cube;
}

/// The roots that the mesh has, made once: whatever the mesh's unit is later, an engine loads this file.
Result<DdsTexture> rootsOf(const Mesh& mesh) {
    const double spacing = kFurSpacing * static_cast<double>(mesh.bounds.radius);
    auto set = makeRoots(mesh, {.density = 1 / (spacing * spacing), .lean = 0.3, .comb = {0.6, -0.5, 0.6}});
    if (!set) return set.error();
    const auto texture = buildRootTexture(*set);
    if (!texture) return texture.error();
    return makeDds(texture->image, DdsFormat::Rgba32F, false);
}

/// Strands: the effect draws them as parts of the mesh.
Result<void> addFur(EngineScene& scene, Textures& textures, bool strands) {
    const std::pair<const char*, double> kValues[] = {{"gFurLength", kFurLength}, {"gFurSpacing", kFurSpacing}, {"gFurLayers", kFurLayers}};
    for (const auto& [name, value] : kValues)
        scene.workspace.parameters.try_emplace(name, std::vector<double>{value});
    if (const auto added = textures.add(scene.workspace, "gFurCubeMap", furCube()); !added) return added;
    const DdsTexture sphere = makeDds(verify::furPattern(2 * kFurTexture, 6), DdsFormat::Rgba8, true);
    if (const auto added = textures.add(scene.workspace, "gFurSphereMap", sphere); !added) return added;
    const auto roots = rootsOf(scene.mesh);
    if (!roots) return roots.error();
    if (strands)
        if (const auto grown = addRibbons(scene.mesh, roots->images.front()); !grown) return grown.error();
    return textures.add(scene.workspace, "gFurRootsMap", *roots);
}

EngineScene sceneOf(const InvarianceOptions& options) {
    if (!options.mesh || !options.workspace) return {.mesh = invarianceMesh(), .workspace = invarianceWorkspace()};
    EngineScene scene{.mesh = *options.mesh, .workspace = *options.workspace};
    const PlacedScene placed = placeScene(scene.workspace, scene.mesh.bounds);
    const Camera given = scene.workspace.camera;
    scene.workspace.camera = placed.camera;
    scene.workspace.camera.nearPlane = given.nearPlane; // those that were fitted are fitted again
    scene.workspace.camera.farPlane = given.farPlane;
    scene.workspace.light = placed.light;
    scene.workspace.cameraRelative = false;
    scene.workspace.lightRelative = false;
    return scene;
}

bool wanted(const std::vector<std::string>& only, const std::string& name) {
    return only.empty() || std::ranges::find(only, name) != only.end();
}

Result<Effect> load(const fs::path& file, const InvarianceOptions& options, std::vector<std::pair<std::string, std::string>> defines) {
    defines.emplace_back("TEGUMENT_MAP_SIZE", std::to_string(options.mapSize));
    return loadEffect(file, {.defines = defines, .setting = options.setting});
}

/// A scene, and an effect that was compiled for its lights.
struct Lighting {
    Effect effect;
    EngineScene scene;
    bool lamps = false;
};

/// All cases of one technique under one lighting.
class Row {
public:
    Row(gpu::Device& device, const Lighting& lighting, const RunOptions& options)
        : painter_(device, lighting.effect, options), effect_(lighting.effect), technique_(options.technique), scene_(lighting.scene),
          lamps_(lighting.lamps) {}

    [[nodiscard]] bool has(const Case& each) const { return each.lamps == lamps_; }
    /// Otherwise there is nothing to draw.
    [[nodiscard]] bool knowsItsLights() const { return !lamps_ || effect_.findParameter("gLampPlace"); }

    /// Draws the scene as it is, so that the painter knows what the shaders read.
    Result<void> begin() {
        auto image = painter_.draw(scene_);
        if (!image) return image.error();
        usual_ = std::move(*image);
        return {};
    }

    [[nodiscard]] InvarianceCell cell(const Case& each) {
        const Subject subject{.effect = effect_, .technique = technique_, .reads = painter_.reads()};
        const Limits limits = limitsOf(subject, each);
        InvarianceCell cell{.technique = technique_, .column = each.column, .name = each.name};
        cell.limit = limits.relativeL2;
        cell.beyondLimit = limits.beyond;
        cell.excused = limits.excused;
        cell.apart = apart(subject, each);
        if (!cell.apart.empty()) return cell;
        const auto difference = measure(each, subject);
        if (!difference) {
            cell.error = difference.error();
            return cell;
        }
        cell.relativeL2 = difference->relativeL2;
        cell.beyond = difference->beyond;
        cell.largest = difference->largest;
        return cell;
    }

private:
    Result<Difference> measure(const Case& each, const Subject& subject) {
        EngineScene before = scene_;
        if (each.common) each.common(before, subject);
        EngineScene after = before;
        each.change(after, subject);
        if (after.mirrored && showsMap(subject)) after.mirrored = false;
        const auto reference = each.common ? painter_.draw(before) : Result<Image>(usual_);
        if (!reference) return reference.error();
        const auto image = painter_.draw(after);
        if (!image) return image.error();
        return compareImages(*image, *reference, kSame);
    }

    Painter painter_;
    const Effect& effect_;
    std::string technique_;
    const EngineScene& scene_;
    bool lamps_ = false;
    Image usual_;
};

InvarianceCell failed(const std::string& technique, const Error& error) {
    InvarianceCell cell{.technique = technique, .column = "", .name = "the scene as it is"};
    cell.error = error;
    return cell;
}

/// Whether any of the cases that are wanted is under this lighting.
bool asked(const InvarianceOptions& options, bool lamps) {
    return std::ranges::any_of(allCases(), [&](const Case& each) {
        return each.lamps == lamps && (wanted(options.cases, each.name) || wanted(options.cases, each.column));
    });
}

/// Errors of the machine end the run; others are results.
Result<void> addRow(std::vector<InvarianceCell>& cells, Row& row, const std::string& technique, const InvarianceOptions& options) {
    if (const auto begun = row.knowsItsLights() ? row.begin() : Result<void>(); !begun) {
        if (begun.error().blame == Blame::Machine) return begun.error();
        cells.push_back(failed(technique, begun.error()));
        return {};
    }
    for (const Case& each : allCases()) {
        if (!row.has(each)) continue;
        if (!wanted(options.cases, each.name) && !wanted(options.cases, each.column)) continue;
        cells.push_back(row.cell(each));
        if (cells.back().error && cells.back().error->blame == Blame::Machine) return *cells.back().error;
    }
    return {};
}

/// "peers/Burley.fx", "Main.fx".
std::string shownName(const fs::path& file) {
    const fs::path folder = file.parent_path().filename();
    return (folder == "peers" ? folder / file.filename() : file.filename()).generic_string();
}

} // namespace

bool InvarianceCell::pass() const {
    if (!apart.empty()) return true;
    return !error && std::isfinite(relativeL2) && relativeL2 <= limit && beyond <= beyondLimit;
}

std::vector<fs::path> effectFiles(const fs::path& effects) {
    std::vector<fs::path> files;
    std::error_code code;
    for (const fs::path& folder : {effects, effects / "peers"})
        for (const auto& entry : fs::directory_iterator(folder, code))
            if (entry.path().extension() == ".fx") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::vector<std::string> invarianceCases() {
    std::vector<std::string> names;
    for (const Case& each : allCases())
        names.push_back(each.name);
    return names;
}

std::vector<std::string> invarianceColumns() {
    std::vector<std::string> columns;
    for (const Case& each : allCases())
        if (std::ranges::find(columns, each.column) == columns.end()) columns.push_back(each.column);
    return columns;
}

Result<std::vector<InvarianceCell>> measureInvariance(gpu::Device& device, const fs::path& file, const InvarianceOptions& options) {
    auto effect = load(file, options, {});
    if (!effect) return effect.error();
    auto lit = load(file, options, lampDefines());
    if (!lit) return lit.error();
    EngineScene scene = sceneOf(options);
    std::error_code code;
    Textures textures(options.folder.empty() ? fs::temp_directory_path(code) : options.folder);
    if (effect->findParameter("gFurLength"))
        if (const auto added = addFur(scene, textures, run::drawsPart(*effect, kStrandsPart) || run::drawsPart(*effect, kUnderfurPart));
            !added)
            return added.error();
    EngineScene lamps = scene;
    addLamps(lamps);
    const std::array lightings = {Lighting{*std::move(effect), std::move(scene), false}, Lighting{*std::move(lit), std::move(lamps), true}};
    std::vector<InvarianceCell> cells;
    for (const Technique& technique : lightings.front().effect.techniques) {
        if (!wanted(options.techniques, technique.name)) continue;
        const RunOptions run{
            .technique = technique.name, .width = options.pictureSize, .height = options.pictureSize, .compiler = options.compiler};
        for (const Lighting& lighting : lightings) {
            if (!asked(options, lighting.lamps)) continue;
            Row row(device, lighting, run);
            if (const auto added = addRow(cells, row, technique.name, options); !added) return added.error();
        }
    }
    for (InvarianceCell& cell : cells)
        cell.effect = shownName(file);
    return cells;
}

} // namespace tegument
