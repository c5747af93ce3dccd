// Fur from afar: one view in ever smaller pictures, each beside the means of a picture whose strands are resolved. How much light and how
// much of the coat's area is lost, with the heights of the map told by their mean alone and by their deviation, too.
//   fur_afar WORKSPACE [-t TECHNIQUE] [--truth SIZE] [--halvings N]
// Run from the root of the source tree, which holds effects/.

#include "host/run/run.h"
#include "lab/measure/need.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <optional>

namespace tegument::measure {

namespace {

struct Settings {
    std::string workspace;
    std::string technique = "CubePosition";
    int truth = 3072;
    int halvings = 6;
};

struct Stage {
    gpu::Device& device;
    const Effect& effect;
    const Mesh& mesh;
    const Workspace& workspace;
    const Settings& settings;

    /// deviation: in place of the workspace's.
    [[nodiscard]] Image draw(int size, std::optional<double> deviation) const {
        RunOptions options{.technique = settings.technique, .width = size, .height = size, .compiler = defaultCompiler()};
        if (deviation) options.parameters["gFurDeviation"] = {*deviation};
        return need(runEffect(device, effect, &mesh, workspace, options)).image;
    }
};

/// Means of so many pixels by so many.
Image smaller(const Image& picture, int by) {
    Image small = picture;
    small.width = picture.width / by;
    small.height = picture.height / by;
    small.pixels.assign(
        static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height) * static_cast<std::size_t>(small.channels), 0.0F);
    for (int y = 0; y < small.height * by; ++y)
        for (int x = 0; x < small.width * by; ++x)
            for (int c = 0; c < small.channels; ++c)
                small.at(x / by, y / by, c) += picture.at(x, y, c) / static_cast<float>(by * by);
    return small;
}

struct Figures {
    double light = 0; // over the truth's, less 1
    double area = 0;
    double rms = 0; // over the mean
};

/// Alpha is what hides the background.
Figures compare(const Image& picture, const Image& truth) {
    double light = 0, trueLight = 0, area = 0, trueArea = 0, squares = 0, count = 0;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            area += static_cast<double>(picture.at(x, y, 3));
            trueArea += static_cast<double>(truth.at(x, y, 3));
            if (truth.at(x, y, 3) <= 0) continue;
            for (int c = 0; c < 3; ++c) {
                const auto drawn = static_cast<double>(picture.at(x, y, c));
                const auto exact = static_cast<double>(truth.at(x, y, c));
                light += drawn;
                trueLight += exact;
                squares += (drawn - exact) * (drawn - exact);
                count += 1;
            }
        }
    return {.light = light / trueLight - 1, .area = area / trueArea - 1, .rms = std::sqrt(squares / count) / (trueLight / count)};
}

void table(const Stage& stage) {
    const Image truth = stage.draw(stage.settings.truth, 0.0);
    const double mm =
        2 * std::tan(0.5 * glm::radians(static_cast<double>(stage.workspace.camera.horizontalFov))) *
        static_cast<double>(glm::length(stage.workspace.camera.position - stage.workspace.camera.target) * stage.mesh.bounds.radius);
    fmt::print(
        "| pixel, mm | picture | mean: light | area | RMS | mean and deviation: light | area | RMS |\n|---|---|---|---|---|---|---|---|\n");
    for (int i = 2; i < 2 + stage.settings.halvings; ++i) {
        const int by = 1 << i;
        const int size = stage.settings.truth / by;
        const Image exact = smaller(truth, by);
        const Figures before = compare(stage.draw(size, 0.0), exact);
        const Figures after = compare(stage.draw(size, {}), exact);
        fmt::print("| {:.2f} | {} | {:+.1f} % | {:+.1f} % | {:.3f} | {:+.1f} % | {:+.1f} % | {:.3f} |\n", mm / size, size,
                   100 * before.light, 100 * before.area, before.rms, 100 * after.light, 100 * after.area, after.rms);
        std::fflush(stdout);
    }
}

int run(int argc, char** argv) {
    Settings settings;
    CLI::App program("Fur in pictures whose pixels are wider than strands", "fur_afar");
    program.add_option("workspace", settings.workspace, "Workspace file; its gFurDeviation and gFurGrain are used")->required();
    program.add_option("-t,--technique", settings.technique, "Technique of Fur.fx")->capture_default_str();
    program.add_option("--truth", settings.truth, "Side of the picture whose strands are resolved")->check(CLI::Range(64, 8192));
    program.add_option("--halvings", settings.halvings, "Pictures, the first a quarter as wide")->check(CLI::Range(1, 8));
    CLI11_PARSE(program, argc, argv);
    const Workspace workspace = need(loadWorkspace(settings.workspace, {.requireMesh = true}));
    const Mesh mesh = need(loadMesh(workspace.meshPath, meshOptions(workspace)));
    const Effect effect = need(loadEffect("effects/Fur.fx"));
    gpu::Device device = need(gpu::Device::create());
    fmt::print("{}\n\n", device.info().name);
    table({device, effect, mesh, workspace, settings});
    return 0;
}

} // namespace

} // namespace tegument::measure

int main(int argc, char** argv) {
    return tegument::measure::run(argc, argv);
}
