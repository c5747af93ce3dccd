#include "lab/bench/bench.h"

#include "lab/bench/textures.h"
#include "lab/bench/traffic.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

namespace tegument::bench {

namespace {

Scene fitted(Scene scene, const BenchOptions& options) {
    const TruthScene truth = truthScene(scene, options.width, options.height);
    fitTextures(scene, reference::visiblePoints(truth.skin, truth.camera, 0));
    return scene;
}

/// A scene with everything that does not depend on who is compared on it.
struct Stage {
    Stage(Scene loaded, const BenchOptions& options)
        : scene(fitted(std::move(loaded), options)), truth(truthScene(scene, options.width, options.height)),
          sample(samplePixels(scene, truth, options.pixels, options.grid)) {}

    Scene scene;
    TruthScene truth; // refers to the scene's mesh
    Sample sample;
    std::vector<glm::dvec3> light;
    std::map<std::string, std::vector<glm::dvec3>> claimed; // by definition
};

Progress progressOf(const Say& say, const std::string& what) {
    return [=](std::size_t done, std::size_t total) { say(fmt::format("{}: pixel {} of {}", what, done, total)); };
}

/// All of them before the first is measured: a mistake in the last must not cost what the others took.
Result<std::vector<Scene>> loadScenes(const BenchOptions& options, const Say& say) {
    const LightSet lights = lightSet(options.lights);
    std::vector<Scene> scenes;
    for (const std::string& name : options.scenes) {
        say(fmt::format("scene {}", name));
        auto scene =
            loadScene(name, {.effects = options.effects, .folder = options.sceneFolder, .width = options.width, .height = options.height});
        if (!scene) return scene.error();
        lightBy(*scene, lights);
        scenes.push_back(std::move(*scene));
    }
    return scenes;
}

Result<std::unique_ptr<Stage>> stageOf(Scene scene, const std::vector<Contender>& contenders, const BenchOptions& options, Part part,
                                       const Say& say) {
    const std::string name = scene.name;
    auto stage = std::make_unique<Stage>(std::move(scene), options);
    if (stage->sample.points.empty())
        return inputError(8075, {.file = stage->scene.file.string()}, "the camera sees no skin that could be compared",
                          "move the camera of the workspace, or choose a larger --size");
    stage->light = trueLight(stage->truth, stage->sample, part, progressOf(say, fmt::format("{}: reference", name)));
    for (const Contender& contender : contenders) {
        if (contender.ownDefinition().empty() || stage->claimed.contains(contender.ownDefinition())) continue;
        stage->claimed[contender.ownDefinition()] = claimedLight(
            stage->truth, stage->sample, contender, part, progressOf(say, fmt::format("{}: reference of {}", name, contender.technique)));
    }
    return stage;
}

Row rowOf(const Stage& stage, const Contender& contender, const Contest& contest) {
    return {.contender = contender,
            .scene = stage.scene.name,
            .workspace = stage.scene.file,
            .mesh = stage.scene.mesh.name,
            .width = contest.width,
            .height = contest.height,
            .mapSize = contest.mapSize,
            .shadowSize = contest.shadowSize > 0 ? contest.shadowSize : contest.mapSize,
            .coverage = stage.sample.coverage,
            .referenceId = stage.sample.id,
            .referencePixels = stage.sample.points.size(),
            .samples = stage.sample.grid * stage.sample.grid,
            .wholeReference = stage.sample.whole};
}

/// Time, bytes and errors of a picture into its row.
Result<void> judge(Row& row, const Stage& stage, const Result<Drawn>& drawn) {
    if (!drawn) return drawn.error();
    const auto errors = errorsOf(drawn->picture, stage.sample, stage.light);
    if (!errors) return errors.error();
    row.errors = *errors;
    if (const std::string definition = row.contender.ownDefinition(); !definition.empty()) {
        const auto own = errorsOf(drawn->picture, stage.sample, stage.claimed.at(definition));
        if (!own) return own.error();
        row.own = *own;
    }
    row.drawn = {.milliseconds = drawn->milliseconds,
                 .gross = drawn->gross,
                 .passes = drawn->passes,
                 .bytes = drawn->bytes,
                 .targetBytes = drawn->targetBytes};
    return {};
}

/// The truth as a picture, and which of its pixels are known.
struct TruthPicture {
    Image light;
    Image mask;
};

TruthPicture truthPicture(const Stage& stage, int width, int height) {
    TruthPicture picture{plainImage(width, height, 3), plainImage(width, height, 3)};
    for (std::size_t i = 0; i < stage.sample.points.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const reference::ShadedPoint& point = stage.sample.points[i];
            picture.light.at(point.x, point.y, c) = static_cast<float>(stage.light[i][c]);
            picture.mask.at(point.x, point.y, c) = 1;
        }
    return picture;
}

/// Only where every pixel has a reference: FLIP looks at neighbourhoods.
void addFlip(std::vector<Row>& rows, std::size_t first, const Stage& stage, const std::vector<Result<Drawn>>& drawn,
             const BenchTools& tools) {
    if (!tools.flip || !stage.sample.whole) return;
    tools.say("FLIP");
    std::vector<const Image*> pictures;
    std::vector<Row*> theirs;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        if (rows[first + i].failure) continue;
        const auto* picture = &(*drawn[i]).picture;
        pictures.push_back(picture);
        theirs.push_back(&rows[first + i]);
    }
    if (pictures.empty()) return;
    const TruthPicture truth = truthPicture(stage, pictures.front()->width, pictures.front()->height);
    const std::vector<double> values = tools.flip(truth.light, pictures, truth.mask);
    for (std::size_t i = 0; i < values.size() && i < theirs.size(); ++i)
        theirs[i]->errors.flip = values[i];
}

/// The pixels that are known, of the truth or of a picture.
Result<void> keepPicture(const std::filesystem::path& folder, const Stage& stage, const Contest& contest, const std::string& name,
                         const Image& image, const Image& mask) {
    Image known = mask;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            for (int c = 0; c < 3; ++c)
                known.at(x, y, c) *= image.at(x, y, c);
    return writeExr(folder / fmt::format("{}-{}-{}.exr", stage.scene.name, contest.mapSize, name), known);
}

Result<void> keepPictures(const std::filesystem::path& folder, const Stage& stage, const Contest& contest,
                          const std::vector<Contender>& contenders, const std::vector<Result<Drawn>>& drawn) {
    if (folder.empty()) return {};
    const TruthPicture truth = truthPicture(stage, contest.width, contest.height);
    if (const auto kept = keepPicture(folder, stage, contest, "truth", truth.light, truth.mask); !kept) return kept;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        if (!drawn[i]) continue;
        std::string name = contenders[i].name() + "-" + contenders[i].setting;
        std::ranges::replace(name, ' ', '_');
        if (const auto kept = keepPicture(folder, stage, contest, name, (*drawn[i]).picture, truth.mask); !kept) return kept;
    }
    return {};
}

Result<void> runContest(gpu::Device& device, const Stage& stage, const Contest& contest, const std::vector<Contender>& contenders,
                        const BenchOptions& options, const BenchTools& tools, std::vector<Row>& rows) {
    const std::string place = fmt::format("{}, maps of {}, shadows of {}", stage.scene.name, contest.mapSize,
                                          contest.shadowSize > 0 ? contest.shadowSize : contest.mapSize);
    auto drawn = drawInTurns(device, entriesOf(contest, contenders), options.frames,
                             [&](const std::string& what) { tools.say(fmt::format("{}: {}", place, what)); });
    for (std::size_t i = 0; options.grid > 1 && i < drawn.size(); ++i)
        if (drawn[i]) {
            auto mean = drawMean(device, {contest, contenders[i]}, options.grid);
            if (mean)
                drawn[i]->picture = std::move(*mean);
            else
                drawn[i] = mean.error();
        }
    const std::size_t first = rows.size();
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        rows.push_back(rowOf(stage, contenders[i], contest));
        if (const auto judged = judge(rows.back(), stage, drawn[i]); !judged) rows.back().failure = judged.error();
    }
    addFlip(rows, first, stage, drawn, tools);
    return keepPictures(options.pictures, stage, contest, contenders, drawn);
}

/// By shaders that count, behind all that is timed.
void addTraffic(gpu::Device& device, const Contest& contest, const Say& say, Row& row) {
    if (row.failure) return;
    say(fmt::format("{}: counting {}", row.scene, row.contender.name()));
    auto traffic = trafficOf(device, contest, row.contender);
    if (traffic)
        row.drawn.traffic = std::move(*traffic);
    else
        row.failure = traffic.error();
}

} // namespace

Result<std::size_t> keepReferences(const std::vector<Contender>& contenders, const BenchOptions& options, Part part, const Say& say) {
    auto scenes = loadScenes(options, say);
    if (!scenes) return scenes.error();
    std::size_t pixels = 0;
    for (Scene& scene : *scenes) {
        const auto stage = stageOf(std::move(scene), contenders, options, part, say);
        if (!stage) return stage.error();
        pixels += (*stage)->sample.points.size();
    }
    return pixels;
}

Result<std::vector<Row>> runBench(gpu::Device& device, const std::vector<Contender>& contenders, const BenchOptions& options,
                                  const BenchTools& tools) {
    auto scenes = loadScenes(options, tools.say);
    if (!scenes) return scenes.error();
    std::vector<Row> rows;
    for (Scene& scene : *scenes) {
        const auto stage = stageOf(std::move(scene), contenders, options, {}, tools.say);
        if (!stage) return stage.error();
        for (const int mapSize : options.mapSizes)
            for (const int shadowSize : options.shadowSizes) {
                const Contest contest{.scene = (*stage)->scene,
                                      .width = options.width,
                                      .height = options.height,
                                      .mapSize = mapSize,
                                      .compiler = options.compiler,
                                      .shadowSize = shadowSize,
                                      .assets = options.assets};
                const std::size_t first = rows.size();
                if (const auto run = runContest(device, **stage, contest, contenders, options, tools, rows); !run) return run.error();
                for (std::size_t i = first; options.count && i < rows.size(); ++i)
                    addTraffic(device, contest, tools.say, rows[i]);
            }
    }
    return rows;
}

} // namespace tegument::bench
