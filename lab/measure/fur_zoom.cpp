// A slow zoom onto fur: how much neighbouring frames differ, beside frames of many samples a pixel, and whether light or coverage is lost
// on the way.
//   fur_zoom MESH [--roots FILE] [--msaa 1,4,8] [--set NAME=X]... [--unit-mm X] [--near M] [--far M] [--steps N] [--frames N] [--size N]
//     [--samples N]
// Run from the root of the source tree, which holds effects/.

#include "host/run/session.h"
#include "lab/measure/need.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdio>
#include <cstring>

namespace {

using namespace tegument;
using measure::need;

/// 50 times nearer in 10 s at 60 frames a second.
const double kStep = std::pow(50.0, 1.0 / 600.0);
constexpr glm::vec3 kView(0.044F, 0.132F, 0.99F); // from the mesh to the eye, unit
constexpr float kFov = 27;                        // degrees
constexpr double kBackground = 0.12;
constexpr double kLeast = 0.02; // difference from the background that counts as mesh

struct Settings {
    std::string mesh;
    std::string roots;
    std::vector<int> msaa = {1}; // samples a pixel of the frames that are judged
    std::map<std::string, double> set;
    double unit = 0;
    double nearest = 0.2; // m
    double farthest = 10;
    int steps = 12;
    int frames = 5; // neighbours, at each distance
    int size = 256;
    int samples = 4; // along each side of a pixel, of the truth
};

using Brightness = std::vector<double>; // of each pixel

/// Draws frames of one kind; what one of them compiled and uploaded serves the next.
class FrameSource {
public:
    /// Pictures of size x grid pixels a side with this many samples each, of which grid x grid make one pixel of the frame.
    FrameSource(const Settings& settings, gpu::Device& device, const Mesh& mesh, const Effect& effect, int grid, int samples)
        : settings_(settings), device_(&device), radius_(mesh.bounds.radius), grid_(grid), session_(device, effect, {&mesh, {}}) {
        options_ = {.technique = settings.roots.empty() ? "Cellular" : "Roots",
                    .width = settings.size * grid,
                    .height = settings.size * grid,
                    .samples = samples,
                    .compiler = defaultCompiler()};
        if (!settings.roots.empty()) options_.textures["gFurRootsMap"] = settings.roots;
        for (const auto& [name, value] : settings.set)
            options_.parameters[name] = {value};
    }

    [[nodiscard]] Brightness frame(double metres) {
        Workspace workspace;
        workspace.head = false;
        workspace.camera.position = kView * static_cast<float>(metres * 1000 / radius_);
        workspace.camera.target = glm::vec3(0);
        workspace.camera.horizontalFov = kFov;
        workspace.light.position = {-3, 4.5F, 4.5F};
        workspace.light.color = {1.9F, 1.8F, 1.65F};
        workspace.background = glm::vec3(static_cast<float>(kBackground));
        static_cast<void>(need(session_.draw(workspace, options_)));
        return reduced(need(device_->readback(*session_.target(""))));
    }

private:
    /// Of RGBA in 32-bit floats.
    [[nodiscard]] Brightness reduced(const std::vector<std::byte>& bytes) const {
        std::vector<float> texels(bytes.size() / sizeof(float));
        std::memcpy(texels.data(), bytes.data(), bytes.size());
        const auto size = static_cast<std::size_t>(settings_.size);
        const auto grid = static_cast<std::size_t>(grid_);
        Brightness picture(size * size, 0.0);
        for (std::size_t i = 0; i < texels.size() / 4; ++i) {
            const double sum =
                static_cast<double>(texels[4 * i]) + static_cast<double>(texels[4 * i + 1]) + static_cast<double>(texels[4 * i + 2]);
            picture[i / (size * grid) / grid * size + i % (size * grid) / grid] += sum / static_cast<double>(3 * grid * grid);
        }
        return picture;
    }

    const Settings& settings_;
    gpu::Device* device_;
    double radius_;
    int grid_;
    RunOptions options_;
    EffectSession session_;
};

/// Sums over pixels.
struct Figures {
    double area = 0;   // pixels that show the mesh
    double light = 0;  // brightness where the truth shows it
    double change = 0; // from frame to frame, there
    double square = 0; // of the difference from the truth, there
    double pixels = 0; // of the truth that show the mesh
};

bool shows(double brightness) {
    return std::abs(brightness - kBackground) > kLeast;
}

void add(Figures& figures, const Brightness& frame, const Brightness& next, const Brightness& truth) {
    for (std::size_t i = 0; i < truth.size(); ++i) {
        figures.area += shows(frame[i]) ? 1 : 0;
        if (!shows(truth[i])) continue;
        figures.pixels += 1;
        figures.light += frame[i];
        figures.change += std::abs(next[i] - frame[i]);
        figures.square += (frame[i] - truth[i]) * (frame[i] - truth[i]);
    }
}

/// Of several kinds of frames the figures at one distance, the truth's last.
std::vector<Figures> zoom(std::vector<FrameSource>& sources, double metres, int frames) {
    std::vector<Figures> figures(sources.size());
    std::vector<Brightness> before;
    for (int i = 0; i < frames; ++i) {
        std::vector<Brightness> now;
        for (FrameSource& source : sources)
            now.push_back(source.frame(metres * std::pow(kStep, i)));
        for (std::size_t kind = 0; i > 0 && kind < sources.size(); ++kind)
            add(figures[kind], before[kind], now[kind], before.back());
        before = std::move(now);
    }
    return figures;
}

void header(const Settings& settings) {
    std::string line = "| metres | pixel, mm | mesh, px | truth's mean \\|dI\\| |";
    for (const std::string_view what : {"ratio", "light, %", "area, %", "RMS error"})
        for (const int samples : settings.msaa)
            line += fmt::format(" {}: {} |", what, samples);
    fmt::print("{}\n|", line);
    for (std::size_t i = 0; i < 4 + 4 * settings.msaa.size(); ++i)
        fmt::print("---|");
    fmt::print("\n");
}

void row(const Settings& settings, std::vector<FrameSource>& sources, double metres) {
    const std::vector<Figures> figures = zoom(sources, metres, settings.frames);
    const Figures& truth = figures.back();
    const double pixels = std::max(truth.pixels, 1.0);
    const double width = 2 * std::tan(static_cast<double>(kFov) / 2 * 3.14159265358979 / 180) * metres * 1000 / settings.size;
    std::string line =
        fmt::format("| {:.2f} | {:.2f} | {:.0f} | {:.4f} |", metres, width, pixels / (settings.frames - 1), truth.change / pixels);
    const auto cells = [&](const auto& value) {
        for (std::size_t kind = 0; kind + 1 < figures.size(); ++kind)
            line += value(figures[kind]);
    };
    cells([&](const Figures& drawn) { return fmt::format(" {:.2f} |", drawn.change / std::max(truth.change, 1e-12)); });
    cells([&](const Figures& drawn) { return fmt::format(" {:.1f} |", 100 * (drawn.light / truth.light - 1)); });
    cells([&](const Figures& drawn) { return fmt::format(" {:.1f} |", 100 * (drawn.area / truth.area - 1)); });
    cells([&](const Figures& drawn) { return fmt::format(" {:.3f} |", std::sqrt(drawn.square / pixels)); });
    fmt::print("{}\n", line);
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("How fur changes from frame to frame of a slow zoom");
    Settings settings;
    std::vector<std::string> sets;
    app.add_option("mesh", settings.mesh)->required();
    app.add_option("--roots", settings.roots, "from tegument fur roots; without: technique Cellular");
    app.add_option("--msaa", settings.msaa, "samples a pixel of the frames, several counts separated by commas")->delimiter(',');
    app.add_option("--set", sets, "NAME=NUMBER, a parameter of the effect; may be repeated");
    app.add_option("--unit-mm", settings.unit);
    app.add_option("--near", settings.nearest, "metres");
    app.add_option("--far", settings.farthest, "metres");
    app.add_option("--steps", settings.steps);
    app.add_option("--frames", settings.frames, "neighbours at each distance")->check(CLI::Range(2, 1000));
    app.add_option("--size", settings.size, "pixels");
    app.add_option("--samples", settings.samples, "along each side of a pixel, of the truth");
    CLI11_PARSE(app, argc, argv);
    for (const std::string& set : sets)
        settings.set[set.substr(0, set.find('='))] = std::atof(set.substr(set.find('=') + 1).c_str());

    MeshOptions load;
    if (settings.unit > 0) load.unitMm = settings.unit;
    const Mesh mesh = need(loadMesh(settings.mesh, load));
    gpu::Device device = need(gpu::Device::create({}));
    const Effect effect = need(loadEffect("effects/FurRoots.fx"));
    std::vector<FrameSource> sources;
    for (const int samples : settings.msaa)
        sources.emplace_back(settings, device, mesh, effect, 1, samples);
    sources.emplace_back(settings, device, mesh, effect, settings.samples, 1);
    fmt::print("{}; {} frames at each distance, samples a pixel: {}\n\n", device.info().name, settings.frames,
               fmt::join(settings.msaa, ", "));
    header(settings);
    for (int i = 0; i < settings.steps; ++i) {
        const double share = settings.steps > 1 ? static_cast<double>(i) / (settings.steps - 1) : 0;
        row(settings, sources, settings.nearest * std::pow(settings.farthest / settings.nearest, share));
    }
    return 0;
}
