#include "lab/bench/fur.h"

#include "host/image/compare.h"
#include "host/image/dds.h"
#include "host/support/file.h"
#include "lab/verify/fur_exact.h"
#include "meshprep/fur/ribbons/ribbons.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::bench {

namespace {

constexpr double kShortest = 0.5; // as roots that are made for a mesh (meshprep/assets/generators.cpp)

/// The mesh with its roots: as one draws it who needs ribbons, as the others do, and as strands in space.
struct FurStage {
    Scene plain;
    Scene furry;
    verify::FurWindow window;
};

glm::dvec3 colourOf(const Workspace& workspace, const char* name, const glm::dvec3& otherwise) {
    const auto found = workspace.parameters.find(name);
    if (found == workspace.parameters.end() || found->second.size() != 3) return otherwise;
    return {found->second[0], found->second[1], found->second[2]};
}

double numberOf(const Workspace& workspace, const char* name, double otherwise) {
    const auto found = workspace.parameters.find(name);
    return found == workspace.parameters.end() || found->second.size() != 1 ? otherwise : found->second.front();
}

/// What the workspace says of strands and their light; all else is as the effects have it.
reference::FurCoat coatOf(const Workspace& workspace) {
    reference::FurCoat coat;
    coat.length = numberOf(workspace, "gFurLength", coat.length);
    coat.lean = numberOf(workspace, "gFurLean", coat.lean);
    coat.root = colourOf(workspace, "gFurRootColor", coat.root);
    coat.tip = colourOf(workspace, "gFurTipColor", coat.tip);
    coat.fill = colourOf(workspace, "gFurFill", coat.fill);
    return coat;
}

verify::FurWindow windowOn(const Scene& scene) {
    verify::FurWindow window{.strands = {.name = scene.name, .technique = "Roots"}, .asks = false};
    verify::StrandsScene& strands = window.strands;
    strands.scene = {.mesh = scene.mesh, .workspace = scene.workspace};
    strands.coat = coatOf(scene.workspace);
    strands.fur.thickness = strands.coat.length * static_cast<double>(scene.mesh.bounds.radius);
    strands.fur.lean = strands.coat.lean * glm::dvec3(0, -1, 0);
    window.shape.round = true;
    return window;
}

/// Once the roots are known.
void shape(verify::FurWindow& window) {
    reference::FurSwept& fur = window.strands.fur;
    fur.spacing = 1 / std::sqrt(window.strands.set.density);
    window.shape.spacing = fur.spacing;
    window.shape.thickness = fur.thickness;
    window.shape.scatter = fur.scatter;
    window.shape.curls = fur.curls;
    window.shape.turns = fur.turns;
    window.shape.tufts = fur.tufts;
    window.shape.tuftSize = fur.tuftSize;
    window.shape.lean = fur.lean;
}

Result<FurStage> stageOf(Scene scene, const BenchOptions& options) {
    removeRibbons(scene.mesh);
    FurStage stage{.plain = scene, .furry = scene, .window = windowOn(scene)};
    if (const auto grown = verify::growRoots(stage.window.strands, {.shortest = kShortest}); !grown) return grown.error();
    shape(stage.window);
    const std::filesystem::path folder = options.sceneFolder.empty() ? cacheFolder() / "bench" / "fur" : options.sceneFolder;
    const std::filesystem::path roots = folder / (scene.file.stem().string() + "_roots.dds");
    if (const auto written = writeDds(roots, makeDds(stage.window.strands.roots, DdsFormat::Rgba32F, false)); !written)
        return written.error();
    for (Scene* drawn : {&stage.plain, &stage.furry})
        drawn->workspace.textures = {{"gFurRootsMap", roots.string()}};
    if (const auto ribbons = addRibbons(stage.furry.mesh, stage.window.strands.roots); !ribbons) return ribbons.error();
    return stage;
}

void lookFrom(Workspace& workspace, const Workspace& own, double away) {
    workspace.camera.position = own.camera.target + static_cast<float>(away) * (own.camera.position - own.camera.target);
}

Result<Errors> furErrors(const Image& picture, const Image& truth) {
    Image drawn = truth;
    double squares = 0;
    double peak = 0;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x)
            for (int c = 0; c < 3; ++c) {
                drawn.at(x, y, c) = picture.at(x, y, c);
                const double error = static_cast<double>(picture.at(x, y, c)) - static_cast<double>(truth.at(x, y, c));
                squares += error * error;
                peak = std::max(peak, static_cast<double>(truth.at(x, y, c)));
            }
    const auto difference = compareImages(drawn, truth);
    if (!difference) return difference.error();
    return Errors{.relativeL2 = difference->relativeL2,
                  .p99 = difference->p99,
                  .p999 = difference->p999,
                  .bias = difference->bias,
                  .psnr = 10 * std::log10(peak * peak * static_cast<double>(truth.pixels.size()) / std::max(squares, 1e-30)),
                  .flip = std::nullopt};
}

/// FurCoat draws parts of the mesh that others do not know.
bool drawsRibbons(const Contender& contender) {
    return contender.effect.stem() == "FurCoat";
}

Row rowOf(const FurStage& stage, const FurView& view, const Entry& entry, const verify::ExactPicture& exact) {
    const auto covered = static_cast<double>(std::ranges::count(exact.covered, 1));
    const int mapSize = entry.contest.mapSize;
    return {.contender = entry.contender,
            .scene = stage.plain.name + view.name,
            .workspace = stage.plain.file,
            .mesh = stage.plain.mesh.name,
            .width = entry.contest.width,
            .height = entry.contest.height,
            .mapSize = mapSize,
            .shadowSize = entry.contest.shadowSize > 0 ? entry.contest.shadowSize : mapSize,
            .coverage = covered / static_cast<double>(exact.covered.size()),
            .referenceId =
                fmt::format("{} strands by rays, {} a pixel", stage.window.strands.set.roots.size(), view.samples * view.samples),
            .referencePixels = exact.covered.size(),
            .wholeReference = true};
}

verify::ExactPicture truthOf(const FurStage& stage, const FurView& view, const BenchOptions& options) {
    verify::FurWindow window = stage.window;
    window.size = options.width;
    window.height = options.height;
    window.samples = view.samples;
    lookFrom(window.strands.scene.workspace, stage.window.strands.scene.workspace, view.away);
    VerifyOptions how;
    how.mapSize = options.mapSizes.front();
    return verify::drawExact(window, how);
}

void judge(Row& row, const Result<Drawn>& drawn, const Image& truth) {
    if (!drawn) {
        row.failure = drawn.error();
        return;
    }
    const auto errors = furErrors(drawn->picture, truth);
    if (!errors) {
        row.failure = errors.error();
        return;
    }
    row.errors = *errors;
    row.drawn = *drawn;
    row.drawn.picture = {};
}

/// From one view.
Result<void> runView(gpu::Device& device, const FurStage& stage, const FurView& view, const std::vector<Contender>& contenders,
                     const BenchOptions& options, const BenchTools& tools, std::vector<Row>& rows) {
    tools.say(fmt::format("{}{}: rays", stage.plain.name, view.name));
    const verify::ExactPicture exact = truthOf(stage, view, options);
    Scene plain = stage.plain, furry = stage.furry;
    for (Scene* scene : {&plain, &furry})
        lookFrom(scene->workspace, stage.plain.workspace, view.away);
    std::vector<Entry> entries;
    for (const Contender& contender : contenders)
        entries.push_back({.contest = {.scene = drawsRibbons(contender) ? furry : plain,
                                       .width = options.width,
                                       .height = options.height,
                                       .mapSize = options.mapSizes.front(),
                                       .compiler = options.compiler,
                                       .shadowSize = options.shadowSizes.front(),
                                       .assets = options.assets},
                           .contender = contender});
    const auto drawn = drawInTurns(device, entries, options.frames,
                                   [&](const std::string& what) { tools.say(fmt::format("{}{}: {}", plain.name, view.name, what)); });
    for (std::size_t i = 0; i < entries.size(); ++i) {
        rows.push_back(rowOf(stage, view, entries[i], exact));
        judge(rows.back(), drawn[i], exact.picture);
    }
    return {};
}

} // namespace

const std::vector<FurView>& furViews() {
    static const std::vector<FurView> views = {{"", 1, 4}, {", 3 times as far", 3, 8}, {", 8 times as far", 8, 8}};
    return views;
}

Result<std::vector<Row>> runFur(gpu::Device& device, const std::vector<Contender>& contenders, const BenchOptions& options,
                                const BenchTools& tools) {
    std::vector<Row> rows;
    for (const std::string& name : options.scenes) {
        auto scene = loadScene(name, {.effects = options.effects,
                                      .folder = options.sceneFolder,
                                      .width = options.width,
                                      .height = options.height,
                                      .needsUvs = false});
        if (!scene) return scene.error();
        tools.say(fmt::format("{}: roots", scene->name));
        const auto stage = stageOf(std::move(*scene), options);
        if (!stage) return stage.error();
        for (const FurView& view : furViews())
            if (const auto run = runView(device, *stage, view, contenders, options, tools, rows); !run) return run.error();
    }
    return rows;
}

} // namespace tegument::bench
