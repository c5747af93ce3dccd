// The tables of docs/design/fur-layers.md: what point shells lose, and what layers and pixels cost.
//   fur_tables error [--layers N...] [--plot FILE.svg]
//   fur_tables time WORKSPACE [--mesh FILE] [--cube-map FILE] [--technique NAME] [--size N] [--frames N] [--layers N...]
// All run from the root of the source tree, which holds effects/.

#include "host/support/file.h"
#include "lab/measure/chart.h"
#include "lab/measure/flat_fur.h"
#include "lab/measure/need.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::measure {

namespace {

struct Settings {
    std::vector<int> layers = {8, 16, 32, 64, 128, 256};
    std::string plot;
    std::string workspace;
    std::string mesh;
    std::string cubeMap;
    std::string technique = "CubePosition";
    int size = 256;
    int frames = 5;
    int referenceLayers = 1024;
};

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

double law(double coat, double tilt, int layers) {
    return 0.27 * coat * std::tan(radians(tilt)) / layers;
}

/// Four spacings across, so that at 70 degrees every ray stays on the patch.
reference::FurView viewOf(double tilt, double pixel) {
    return {.tilt = radians(tilt), .pixel = pixel, .size = static_cast<int>(std::lround(4 / pixel)), .samples = 4};
}

// ---- What shells lose of a flat patch

struct Case {
    double coat;
    double tilt;
    double pixel;
};

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const double coat : {4.0, 12.0})
        for (const double tilt : {0.0, 45.0, 70.0})
            for (const double pixel : {0.25, 0.5})
                if (coat * std::tan(radians(tilt)) < 15) all.push_back({coat, tilt, pixel}); // else rays leave the patch
    return all;
}

constexpr bool within(double value, double low, double high) {
    return value >= low && value <= high;
}

Chart errorChart(const Settings& settings) {
    Chart chart{.title = "Error of point shells over a flat patch, pixel a quarter of a spacing",
                .across = "layers",
                .up = "root mean square error",
                .upTicks = {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1}};
    for (const int layers : settings.layers)
        chart.acrossTicks.push_back(layers);
    return chart;
}

void addToChart(Chart& chart, const Case& drawn, const std::vector<std::pair<double, double>>& points) {
    static const std::array<const char*, 6> kColors = {"#999999", "#1b7837", "#2166ac", "#666666", "#e08214", "#b2182b"};
    const auto color = kColors[static_cast<std::size_t>(drawn.coat > 4 ? 3 : 0) + (drawn.tilt > 60 ? 2U : drawn.tilt > 30 ? 1U : 0U)];
    chart.lines.push_back({fmt::format("coat {:g}, {:g} degrees", drawn.coat, drawn.tilt), color, false, points});
    if (drawn.tilt == 0) return;
    Line predicted{.label = "0.27 H tan t / n", .color = color, .dashed = true};
    for (const double layers : {chart.acrossTicks.front(), chart.acrossTicks.back()})
        predicted.points.emplace_back(layers, law(drawn.coat, drawn.tilt, static_cast<int>(layers)));
    chart.lines.push_back(std::move(predicted));
}

void errorTable(gpu::Device& device, const Settings& settings) {
    FlatFur fur = need(FlatFur::create(device, {}));
    Chart chart = errorChart(settings);
    std::string header = "| coat | tilt | pixel |";
    std::string rule = "|---|---|---|";
    for (const int layers : settings.layers) {
        header += fmt::format(" {} |", layers);
        rule += "---|";
    }
    fmt::print("{}\n{}\n", header, rule);
    double lowest = 10;
    double highest = 0;
    for (const Case& drawn : cases()) {
        fur.setCoat(drawn.coat);
        const reference::FurView view = viewOf(drawn.tilt, drawn.pixel);
        const auto truth = fur.truth(view);
        std::string row = fmt::format("| {:g} | {:g} | 1/{:g} |", drawn.coat, drawn.tilt, 1 / drawn.pixel);
        std::vector<std::pair<double, double>> points;
        for (const int layers : settings.layers) {
            const auto error = reference::furError(need(fur.draw(view, layers)), truth);
            const double predicted = law(drawn.coat, drawn.tilt, layers);
            const bool judged = within(predicted, 0.012, 0.1);
            points.emplace_back(layers, error.rms);
            row += judged ? fmt::format(" {:.4f} ({:.2f}) |", error.rms, error.rms / predicted) : fmt::format(" {:.4f} |", error.rms);
            if (!judged) continue;
            lowest = std::min(lowest, error.rms / predicted);
            highest = std::max(highest, error.rms / predicted);
        }
        if (drawn.pixel == 0.25) addToChart(chart, drawn, points);
        fmt::print("{}\n", row);
        std::fflush(stdout);
    }
    fmt::print("\nError over the law, where that gives 0.012 to 0.1: {:.2f} to {:.2f}\n", lowest, highest);
    if (settings.plot.empty()) return;
    if (const auto written = writeFile(settings.plot, svg(chart)); !written) stop(written.error());
    fmt::print("wrote {}\n", settings.plot);
}

// ---- What a mesh costs

struct Stage {
    gpu::Device& device;
    Effect effect;
    Workspace workspace;
    Mesh mesh;
};

Stage stageOf(gpu::Device& device, const Settings& settings) {
    Workspace workspace = need(loadWorkspace(settings.workspace, {.requireMesh = settings.mesh.empty()}));
    if (!settings.cubeMap.empty()) workspace.textures["gFurCubeMap"] = std::filesystem::absolute(settings.cubeMap).string();
    Mesh mesh = need(loadMesh(settings.mesh.empty() ? workspace.meshPath : settings.mesh, meshOptions(workspace)));
    return {device, need(loadEffect("effects/Fur.fx")), std::move(workspace), std::move(mesh)};
}

RunResult draw(const Stage& stage, const Settings& settings, int size, int layers, int frames) {
    return need(runEffect(stage.device, stage.effect, &stage.mesh, stage.workspace,
                          {.technique = settings.technique,
                           .width = size,
                           .height = size,
                           .compiler = defaultCompiler(),
                           .parameters = {{"gFurLayers", {static_cast<double>(layers)}}},
                           .warmUpFrames = frames > 1 ? 2 : 0,
                           .frames = frames}));
}

double shellsTime(const RunResult& run) {
    double sum = 0;
    for (const PassReport& pass : run.passes)
        if (pass.name == "Shells") sum += pass.milliseconds;
    return sum;
}

double frameTime(const RunResult& run) {
    double sum = 0;
    for (const PassReport& pass : run.passes)
        sum += pass.milliseconds;
    return sum;
}

bool isCovered(const Image& picture, int x, int y) {
    return picture.at(x, y, 3) > 0;
}

std::size_t covered(const Image& picture) {
    std::size_t count = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            count += isCovered(picture, x, y) ? 1 : 0;
    return count;
}

struct PictureError {
    double relative = 0;
    double bias = 0; // of the mean
};

PictureError errorOf(const Image& picture, const Image& truth) {
    double squares = 0;
    double whole = 0;
    double difference = 0;
    double sum = 0;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            if (!isCovered(truth, x, y)) continue;
            for (int c = 0; c < 3; ++c) {
                const double exact = static_cast<double>(truth.at(x, y, c));
                const double error = static_cast<double>(picture.at(x, y, c)) - exact;
                squares += error * error;
                whole += exact * exact;
                difference += error;
                sum += exact;
            }
        }
    return {std::sqrt(squares / whole), difference / sum};
}

/// The k of y = c x^k, by least squares of the logarithms.
double exponent(const std::vector<std::pair<double, double>>& points) {
    double x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& [across, up] : points) {
        x += std::log(across);
        y += std::log(up);
        xx += std::log(across) * std::log(across);
        xy += std::log(across) * std::log(up);
    }
    const auto n = static_cast<double>(points.size());
    return (n * xy - x * y) / (n * xx - x * x);
}

void layersTable(const Stage& stage, const Settings& settings) {
    const Image truth = draw(stage, settings, settings.size, settings.referenceLayers, 1).image;
    fmt::print("| layers | frame, ms | Shells, ms | relative L2 | bias |\n|---|---|---|---|---|\n");
    std::vector<std::pair<double, double>> times;
    for (const int layers : settings.layers) {
        const RunResult run = draw(stage, settings, settings.size, layers, settings.frames);
        const PictureError error = errorOf(run.image, truth);
        times.emplace_back(layers, shellsTime(run));
        fmt::print("| {} | {:.3f} | {:.3f} | {:.1f} % | {:+.2f} % |\n", layers, frameTime(run), shellsTime(run), 100 * error.relative,
                   100 * error.bias);
        std::fflush(stdout);
    }
    fmt::print("\nThe time of Shells grows with layers to the power {:.2f}. Errors are against {} layers.\n\n", exponent(times),
               settings.referenceLayers);
}

void pixelsTable(const Stage& stage, const Settings& settings) {
    constexpr int kLayers = 32;
    fmt::print("| picture | covered pixels | Shells, ms |\n|---|---|---|\n");
    std::vector<std::pair<double, double>> times;
    for (const int size : {settings.size / 2, settings.size, 2 * settings.size, 4 * settings.size}) {
        const RunResult run = draw(stage, settings, size, kLayers, settings.frames);
        const std::size_t pixels = covered(run.image);
        times.emplace_back(static_cast<double>(pixels), shellsTime(run));
        fmt::print("| {0} x {0} | {1} | {2:.3f} |\n", size, pixels, shellsTime(run));
        std::fflush(stdout);
    }
    fmt::print("\nThe time of {} layers grows with covered pixels to the power {:.2f}; {:.2f} between the two largest pictures.\n", kLayers,
               exponent(times), exponent({times[times.size() - 2], times.back()}));
}

void timeTable(gpu::Device& device, const Settings& settings) {
    const Stage stage = stageOf(device, settings);
    fmt::print("{}, {} triangles, {}, {} x {}, median of {} frames\n\n", stage.mesh.name, stage.mesh.indices.size() / 3, settings.technique,
               settings.size, settings.size, settings.frames);
    layersTable(stage, settings);
    pixelsTable(stage, settings);
}

int run(int argc, char** argv) {
    Settings settings;
    CLI::App program("Tables of docs/design/fur-layers.md", "fur_tables");
    program.require_subcommand(1);
    const auto addLayers = [&](CLI::App* command) {
        command->add_option("--layers", settings.layers, "Numbers of layers")->delimiter(',')->check(CLI::Range(1, 4096));
    };
    CLI::App* error = program.add_subcommand("error", "Errors on a flat patch, by layers and tilt");
    addLayers(error);
    error->add_option("--plot", settings.plot, "Draw them, too (SVG)");
    CLI::App* time = program.add_subcommand("time", "Times and errors on a mesh, by layers and by covered pixels");
    time->add_option("workspace", settings.workspace, "Workspace file")->required();
    time->add_option("--mesh", settings.mesh, "Mesh in place of the workspace's");
    time->add_option("--cube-map", settings.cubeMap, "Fur map in place of the workspace's");
    time->add_option("-t,--technique", settings.technique, "Technique of Fur.fx")->capture_default_str();
    time->add_option("--size", settings.size, "Side of the picture")->capture_default_str();
    time->add_option("--frames", settings.frames, "Frames to time")->capture_default_str();
    time->add_option("--reference-layers", settings.referenceLayers, "Layers of the picture that errors are against")
        ->capture_default_str();
    addLayers(time);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& failure) {
        return program.exit(failure) == 0 ? 0 : 2;
    }
    gpu::Device device = need(gpu::Device::create());
    fmt::print("{}, {}\n\n", device.info().name, device.info().driver);
    if (error->parsed()) errorTable(device, settings);
    if (time->parsed()) timeTable(device, settings);
    return 0;
}

} // namespace

} // namespace tegument::measure

int main(int argc, char** argv) {
    return tegument::measure::run(argc, argv);
}
