// Every technique of every effect on hostile scenes: no value of any target may be NaN or infinite.

#include "host/image/dds.h"
#include "host/run/parts.h"
#include "host/run/pixels.h"
#include "host/support/temporary.h"
#include "lab/stability/work.h"
#include "meshprep/fur/ribbons/ribbons.h"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace tegument::bench::stability {

namespace {

/// What the techniques of one effect did over all scenes.
struct Tally {
    std::size_t values = 0; // that are not finite
    std::set<std::string> scenes;
    std::string first;
    std::set<std::string> refusals;
};

Result<void> scan(const Context& context, EffectSession& session, const SessionFrame& frame, const std::string& what, Tally& tally) {
    std::vector<std::string> names = frame.targets;
    names.emplace_back();
    for (const std::string& name : names) {
        gpu::Texture* target = session.target(name);
        if (!target) continue;
        const auto image = run::readBack(context.device, *target);
        if (!image) return image.error();
        const NotFinite found = notFinite(*image);
        if (found.count == 0) continue;
        tally.values += found.count;
        tally.scenes.insert(what);
        if (tally.first.empty())
            tally.first = fmt::format("{}: {} ({}, {}) is {}", what, name.empty() ? "picture" : name, found.x, found.y, found.value);
    }
    return {};
}

Result<void> drawScene(const Context& context, const Effect& effect, const std::string& setting, const HardScene& scene, Tally& tally) {
    EffectSession session(context.device, effect, {.mesh = &scene.mesh});
    for (const Technique& technique : effect.techniques) {
        const RunOptions options = runOptions(context, effect, technique.name, scene, context.options.size);
        const auto frame = session.draw(scene.workspace, options);
        if (!frame && frame.error().blame == Blame::Machine) return frame.error();
        if (!frame)
            tally.refusals.insert(fmt::format("{}: TG{}", scene.name, frame.error().diagnostics.front().code));
        else if (const auto scanned =
                     scan(context, session, *frame, fmt::format("{} [{}], {}", technique.name, setting, scene.name), tally);
                 !scanned)
            return scanned.error();
    }
    return {};
}

/// With strands, for an effect that draws them; as it is where none can stand on the mesh. `file`: for their roots.
HardScene withStrands(HardScene scene, const std::filesystem::path& file) {
    constexpr std::size_t kRoots = 600;
    HardScene grown = scene;
    const auto roots = growRibbons(grown.mesh, {.count = kRoots});
    if (!roots) return scene;
    if (!writeDds(file, makeDds(*roots, DdsFormat::Rgba32F, false))) return scene;
    grown.workspace.textures["gFurRootsMap"] = file.string();
    return grown;
}

std::string causes(const Tally& tally) {
    std::string text = tally.first;
    if (tally.scenes.size() > 1) text += fmt::format("; and {} more scenes", tally.scenes.size() - 1);
    if (!tally.refusals.empty()) text += fmt::format("{}refused: {}", text.empty() ? "" : "; ", fmt::join(tally.refusals, ", "));
    return text.empty() ? "-" : text;
}

/// Files that the scenes need, and that go with this.
struct Files {
    Temporary folder{std::filesystem::temp_directory_path() / fmt::format("tegument_stability_{}", ::getpid())};
    std::filesystem::path roots = folder.path() / "roots.dds";
};

/// All scenes in one setting. How many were drawn: those with more light that the effect knows nothing of are left out.
Result<std::size_t> drawScenes(const Context& context, const std::filesystem::path& file, const std::string& setting,
                               const std::vector<HardScene>& scenes, const Files& files, Tally& tally) {
    std::size_t drawn = 0;
    for (const HardScene& scene : scenes) {
        const auto effect = load(context, file, setting, scene.defines);
        if (!effect) return effect.error();
        if (!scene.defines.empty() && !knowsLightsOf(*effect, scene)) continue;
        context.say(fmt::format("finite: {} [{}], {}", file.stem().string(), setting, scene.name));
        const bool strands = run::drawsPart(*effect, kStrandsPart) || run::drawsPart(*effect, kUnderfurPart);
        const auto done = drawScene(context, *effect, setting, strands ? withStrands(scene, files.roots) : scene, tally);
        if (!done) return done.error();
        ++drawn;
    }
    return drawn;
}

std::string drawnCase(std::size_t scenes, std::size_t techniques, const std::vector<std::string>& settings) {
    return fmt::format("{} scenes, {} technique{}, {}", scenes, techniques, techniques > 1 ? "s" : "",
                       settings.front().empty() ? "no settings" : fmt::format("{}", fmt::join(settings, " and ")));
}

} // namespace

Result<void> measureFinite(const Context& context) {
    const Files files;
    std::vector<HardScene> scenes = hostileScenes();
    const auto lit = litScenes(files.folder.path());
    if (!lit) return lit.error();
    scenes.insert(scenes.end(), lit->begin(), lit->end());
    for (const auto& file : effectFiles(context)) {
        Tally tally;
        const auto settings = outerSettings(context, file);
        if (!settings) return settings.error();
        const auto effect = load(context, file, settings->front());
        if (!effect) return effect.error();
        std::size_t count = 0;
        for (const std::string& setting : *settings) {
            const auto drawn = drawScenes(context, file, setting, scenes, files, tally);
            if (!drawn) return drawn.error();
            count = *drawn;
        }
        context.report.rows.push_back({.module = file.stem().string(),
                                       .hardCase = drawnCase(count, effect->techniques.size(), *settings),
                                       .figure = "values that are not finite, all targets",
                                       .value = static_cast<double>(tally.values),
                                       .limit = 0,
                                       .cause = causes(tally),
                                       .notFinite = tally.values,
                                       .why = "finite numbers in, finite numbers out"});
    }
    return {};
}

} // namespace tegument::bench::stability
