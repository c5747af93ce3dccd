// A slow zoom onto fur: how much neighbouring frames differ, beside frames of many samples a pixel, and whether light or coverage is lost
// on the way.
//   fur_zoom MESH [--roots FILE] [--unit-mm X] [--near M] [--far M] [--steps N] [--size N] [--samples N]
// Run from the root of the source tree, which holds effects/.

#include "host/run/run.h"
#include "tests/measure/need.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>

namespace {

using namespace tegument;
using measure::stop;

/// 50 times nearer in 10 s at 60 frames a second.
const double kStep = std::pow(50.0, 1.0 / 600.0);
constexpr glm::vec3 kView(0.044F, 0.132F, 0.99F); // from the mesh to the eye, unit
constexpr double kLeast = 0.02;                   // difference from the background that counts as mesh

struct Settings {
    std::string mesh;
    std::string roots;
    double unit = 0;
    double nearest = 0.2; // m
    double farthest = 10;
    int steps = 12;
    int size = 256;
    int samples = 4; // along each side of a pixel, of the truth
    std::vector<double> layers;
};

class Zoom {
public:
    Zoom(const Settings& settings, gpu::Device& device, const Mesh& mesh, const Effect& effect)
        : settings_(settings), device_(&device), mesh_(&mesh), effect_(&effect) {}

    /// Brightness of each pixel, the mean of samples x samples of them.
    [[nodiscard]] std::vector<double> frame(double metres, int samples) const {
        Workspace workspace;
        workspace.head = false;
        workspace.camera.position = kView * static_cast<float>(metres * 1000 / mesh_->bounds.radius);
        workspace.camera.target = glm::vec3(0);
        workspace.camera.horizontalFov = 27;
        workspace.light.position = {-3, 4.5F, 4.5F};
        workspace.light.color = {1.9F, 1.8F, 1.65F};
        workspace.background = glm::vec3(0.12F);
        const int side = settings_.size * samples;
        RunOptions options{.technique = settings_.roots.empty() ? "Cellular" : "Roots", .width = side, .height = side};
        options.compiler = defaultCompiler();
        if (!settings_.roots.empty()) options.textures["gFurRootsMap"] = settings_.roots;
        auto run = runEffect(*device_, *effect_, mesh_, workspace, options);
        if (!run) stop(run.error());
        std::vector<double> picture(static_cast<std::size_t>(settings_.size) * static_cast<std::size_t>(settings_.size), 0.0);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                picture[static_cast<std::size_t>(y / samples * settings_.size + x / samples)] +=
                    static_cast<double>(run->image.at(x, y, 0) + run->image.at(x, y, 1) + run->image.at(x, y, 2)) / (3 * samples * samples);
        return picture;
    }

private:
    const Settings& settings_;
    gpu::Device* device_;
    const Mesh* mesh_;
    const Effect* effect_;
};

struct Figures {
    double area = 0; // pixels that show the mesh
    double mean = 0; // brightness there
    double change = 0;
    double error = 0; // RMS of direct - truth
};

Figures compare(const std::vector<double>& direct, const std::vector<double>& next, const std::vector<double>& truth) {
    Figures figures;
    double inTruth = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        figures.area += std::abs(direct[i] - 0.12) > kLeast ? 1 : 0;
        if (std::abs(truth[i] - 0.12) <= kLeast) continue;
        inTruth += 1;
        figures.mean += direct[i];
        figures.change += std::abs(next[i] - direct[i]);
        figures.error += (direct[i] - truth[i]) * (direct[i] - truth[i]);
    }
    const double count = std::max(inTruth, 1.0);
    return {figures.area, figures.mean / count, figures.change / count, std::sqrt(figures.error / count)};
}

void row(const Zoom& zoom, const Settings& settings, double metres) {
    const auto direct = zoom.frame(metres, 1);
    const auto next = zoom.frame(metres * kStep, 1);
    const auto truth = zoom.frame(metres, settings.samples);
    const auto nextTruth = zoom.frame(metres * kStep, settings.samples);
    const Figures drawn = compare(direct, next, truth);
    const Figures real = compare(truth, nextTruth, truth);
    const double pixel = 2 * std::tan(27.0 / 2 * 3.14159265358979 / 180) * metres * 1000 / settings.size;
    fmt::print("| {:.2f} | {:.2f} | {:.0f} | {:.4f} | {:.4f} | {:.2f} | {:.1f} | {:.1f} | {:.3f} |\n", metres, pixel, real.area,
               drawn.change, real.change, drawn.change / real.change, 100 * (drawn.mean / real.mean - 1),
               100 * (drawn.area / real.area - 1), drawn.error);
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("How fur changes from frame to frame of a slow zoom");
    Settings settings;
    app.add_option("mesh", settings.mesh)->required();
    app.add_option("--roots", settings.roots, "from tegument fur roots; without: technique Cellular");
    app.add_option("--unit-mm", settings.unit);
    app.add_option("--near", settings.nearest, "metres");
    app.add_option("--far", settings.farthest, "metres");
    app.add_option("--steps", settings.steps);
    app.add_option("--size", settings.size, "pixels");
    app.add_option("--samples", settings.samples, "along each side of a pixel, of the truth");
    CLI11_PARSE(app, argc, argv);

    MeshOptions load;
    if (settings.unit > 0) load.unitMm = settings.unit;
    const auto mesh = loadMesh(settings.mesh, load);
    if (!mesh) stop(mesh.error());
    auto device = gpu::Device::create({});
    if (!device) stop(device.error());
    const auto effect = loadEffect("effects/FurRoots.fx");
    if (!effect) stop(effect.error());
    const Zoom zoom(settings, *device, *mesh, *effect);
    fmt::print("{}\n\n| metres | pixel, mm | mesh, px | mean \\|dI\\| | truth's | ratio | light, % | area, % | RMS error |\n"
               "|---|---|---|---|---|---|---|---|---|\n",
               device->info().name);
    for (int i = 0; i < settings.steps; ++i) {
        const double share = settings.steps > 1 ? static_cast<double>(i) / (settings.steps - 1) : 0;
        row(zoom, settings, settings.nearest * std::pow(settings.farthest / settings.nearest, share));
    }
    return 0;
}
