// The tables of docs/design/speed-error.md: what culling in texture space takes and saves, what the seams' repair is worth.
//   skin_tables culling|seams WORKSPACE... [--size N] [--map-size N] [--frames N]

#include "host/run/run.h"
#include "lab/measure/need.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unistd.h>

namespace tegument {

namespace {

using measure::need;
using measure::stop;

namespace fs = std::filesystem;

struct Settings {
    std::vector<std::string> workspaces;
    int size = 1024;
    int mapSize = 1024;
    int frames = 1;
};

/// One way of drawing: what stands in a row of a table.
struct Way {
    std::string technique;
    int setting = 2;
    bool repair = true;
    bool cull = false;
};

constexpr std::array<const char*, 3> kSettingNames = {"seed", "deon2007", "corrected"};

struct Stage {
    gpu::Device& device;
    Workspace workspace;
    Mesh mesh;
};

Effect load(const std::string& file, const Way& way, int mapSize) {
    return need(loadEffect(file, {.defines = {{"TEGUMENT_SETTING", std::to_string(way.setting)},
                                              {"TEGUMENT_MAP_SIZE", std::to_string(mapSize)},
                                              {"TEGUMENT_SEAM_REPAIR", way.repair ? "1" : "0"}}}));
}

RunResult draw(const Stage& stage, const Way& way, const Settings& settings, int mapSize, std::vector<std::string> dump = {}) {
    RunOptions options{.technique = way.technique, .width = settings.size, .height = settings.size, .frames = settings.frames};
    options.warmUpFrames = settings.frames > 1 ? 2 : 0;
    options.dump = std::move(dump);
    if (way.cull) options.parameters["gUsePrePass"] = {1};
    return need(runEffect(stage.device, load("effects/Main.fx", way, mapSize), &stage.mesh, stage.workspace, options));
}

double total(const RunResult& result, const std::vector<std::string>& starts) {
    double sum = 0;
    for (const PassReport& pass : result.passes)
        if (starts.empty() || std::ranges::any_of(starts, [&](const std::string& start) { return pass.name.starts_with(start); }))
            sum += pass.milliseconds;
    return sum;
}

struct Difference {
    double relative = 0; // L2 of the difference over L2 of the reference
    double p99 = 0;      // of |difference| over the reference's mean
    double largest = 0;
    std::size_t values = 0;
};

/// Over the pixels that the mask chooses, all three channels.
template <class Mask>
Difference difference(const Image& picture, const Image& reference, Mask&& mask) {
    std::vector<double> errors;
    double squares = 0;
    double squaresOfReference = 0;
    double sum = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            if (!mask(x, y)) continue;
            for (int c = 0; c < 3; ++c) {
                const double truth = static_cast<double>(reference.at(x, y, c));
                const double error = static_cast<double>(picture.at(x, y, c)) - truth;
                errors.push_back(std::abs(error));
                squares += error * error;
                squaresOfReference += truth * truth;
                sum += truth;
            }
        }
    Difference result{.values = errors.size()};
    if (errors.empty() || sum <= 0) return result;
    const double mean = sum / static_cast<double>(errors.size());
    result.relative = std::sqrt(squares / squaresOfReference);
    const std::size_t at = std::min(errors.size() - 1, errors.size() * 99 / 100);
    std::ranges::nth_element(errors, errors.begin() + static_cast<std::ptrdiff_t>(at));
    result.p99 = errors[at] / mean;
    result.largest = *std::ranges::max_element(errors) / mean;
    return result;
}

bool everywhere(int, int) {
    return true;
}

/// Of the texels inside the charts the share at which a pass in texture space is still drawn: the depth that EQUAL asks for.
double processed(const RunResult& culled, const RunResult& whole) {
    const Image& depth = culled.dumped.at("gUnwrapDepthMap");
    const Image& charts = whole.dumped.at("gIrradianceMap");
    std::size_t alive = 0;
    std::size_t covered = 0;
    for (int y = 0; y < charts.height; ++y)
        for (int x = 0; x < charts.width; ++x) {
            if (charts.at(x, y, 3) > 0.995F) continue;
            ++covered;
            alive += depth.at(x, y, 0) == 0 ? 1 : 0;
        }
    return covered > 0 ? static_cast<double>(alive) / static_cast<double>(covered) : 0;
}

Stage stageOf(gpu::Device& device, const std::string& file) {
    Workspace workspace = need(loadWorkspace(file));
    Mesh mesh = need(loadMesh(workspace.meshPath, meshOptions(workspace)));
    return {device, std::move(workspace), std::move(mesh)};
}

void cullingTable(gpu::Device& device, const Settings& settings) {
    fmt::print("| view | technique | setting | texels processed | irradiance, ms | blurs, ms | prepasses, ms | all passes, ms | relative "
               "L2 | largest "
               "difference |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& file : settings.workspaces) {
        const Stage stage = stageOf(device, file);
        for (const char* technique : {"DEonLuebke", "Gosselin"})
            for (const int setting : {0, 2}) {
                Way way{.technique = technique, .setting = setting};
                const RunResult whole = draw(stage, way, settings, settings.mapSize, {"gIrradianceMap"});
                way.cull = true;
                const RunResult culled = draw(stage, way, settings, settings.mapSize, {"gUnwrapDepthMap"});
                const Difference error = difference(culled.image, whole.image, everywhere);
                const auto pair = [&](const std::vector<std::string>& names) {
                    return fmt::format("{:.3f} of {:.3f}", total(culled, names), total(whole, names));
                };
                fmt::print("| {} | {} | {} | {:.1f} % | {} | {} | {:.3f} | {} | {} | {} |\n", fs::path(file).stem().string(), technique,
                           kSettingNames.at(static_cast<std::size_t>(setting)), 100 * processed(culled, whole), pair({"Irradiance"}),
                           pair({"Convolution", "Blur", "Poisson"}), total(culled, {"PrePass"}), pair({}),
                           error.largest == 0 ? "0" : fmt::format("{:.2f} %", 100 * error.relative),
                           error.largest == 0 ? "0, every bit equal" : fmt::format("{:.1f} % of the mean", 100 * error.largest));
                std::fflush(stdout);
            }
    }
}

constexpr int kBorder = 3; // texels inside a chart that count as its border: what the narrowest repair reaches

/// White within kBorder texels of a chart's border, black elsewhere, as a file that an effect can load.
fs::path writeBorders(const Image& irradiance) {
    Image map{.width = irradiance.width, .height = irradiance.height, .channels = 3};
    map.pixels.assign(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height) * 3, 0.0F);
    const auto outside = [&](int x, int y) {
        return x < 0 || y < 0 || x >= map.width || y >= map.height || irradiance.at(x, y, 3) > 0.995F;
    };
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            bool near = false;
            for (int dy = -kBorder; dy <= kBorder && !near; ++dy)
                for (int dx = -kBorder; dx <= kBorder && !near; ++dx)
                    near = outside(x + dx, y + dy);
            for (int c = 0; c < 3 && near; ++c)
                map.at(x, y, c) = 1;
        }
    const fs::path file = fs::temp_directory_path() / fmt::format("tegument-borders-{}.png", ::getpid());
    if (const auto written = writePng(file, map, PngEncoding::Raw); !written) stop(written.error());
    return file;
}

/// The pixels of the view that show a chart's border.
Image seamMask(const Stage& stage, const Settings& settings) {
    const RunResult whole = draw(stage, {.technique = "DEonLuebke"}, settings, settings.mapSize, {"gIrradianceMap"});
    const fs::path borders = writeBorders(whole.dumped.at("gIrradianceMap"));
    RunOptions options{.width = settings.size, .height = settings.size};
    options.textures["gSkinMap"] = borders.string();
    Workspace black = stage.workspace;
    black.background = glm::vec3(0);
    Image mask = need(runEffect(stage.device, load("effects/OriginalTexture.fx", {}, settings.mapSize), &stage.mesh, black, options)).image;
    std::error_code code;
    fs::remove(borders, code);
    return mask;
}

void seamRow(const Stage& stage, const std::string& view, const Way& way, const Settings& settings, const Image& reference,
             const Image& mask) {
    const Image picture = draw(stage, way, settings, settings.mapSize).image;
    const auto onSeam = [&](int x, int y) { return mask.at(x, y, 0) > 0.25F; };
    const auto elsewhere = [&](int x, int y) { return mask.at(x, y, 0) <= 0.0F; };
    const Difference seam = difference(picture, reference, onSeam);
    const Difference inside = difference(picture, reference, elsewhere);
    fmt::print("| {} | {} | {} | {} | {} | {} | {:.2f} % | {:.1f} % | {:.2f} % |\n", view, way.technique,
               kSettingNames.at(static_cast<std::size_t>(way.setting)), way.repair ? "on" : "off", way.cull ? "on" : "off", seam.values / 3,
               100 * seam.relative, 100 * seam.p99, 100 * inside.relative);
    std::fflush(stdout);
}

void seamTable(gpu::Device& device, const Settings& settings) {
    fmt::print(
        "| view | technique | setting | repair | culling | pixels on seams | relative L2 on seams | 99th percentile on seams | relative L2 "
        "elsewhere |\n|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& file : settings.workspaces) {
        const Stage stage = stageOf(device, file);
        const Image mask = seamMask(stage, settings);
        for (const char* technique : {"DEonLuebke", "Gosselin"})
            for (const int setting : {0, 2}) {
                const Image reference = draw(stage, {.technique = technique, .setting = setting}, settings, 4 * settings.mapSize).image;
                for (const bool repair : {true, false})
                    for (const bool cull : {false, true})
                        seamRow(stage, fs::path(file).stem().string(), {technique, setting, repair, cull}, settings, reference, mask);
            }
    }
}

int run(int argc, char** argv) {
    Settings settings;
    CLI::App program("Tables of docs/design/speed-error.md", "skin_tables");
    program.require_subcommand(1);
    const auto add = [&](const char* name, const char* help) {
        CLI::App* command = program.add_subcommand(name, help);
        command->add_option("workspaces", settings.workspaces, "Workspace files")->required();
        command->add_option("--size", settings.size, "Side of the picture")->capture_default_str();
        command->add_option("--map-size", settings.mapSize, "Side of the maps; the seams' reference has four times that")
            ->capture_default_str();
        command->add_option("--frames", settings.frames, "Frames to time")->capture_default_str();
        return command;
    };
    const CLI::App* culling = add("culling", "Texels processed, times and errors of culling");
    add("seams", "Errors on the charts' borders");
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return program.exit(error) == 0 ? 0 : 2;
    }
    gpu::Device device = need(gpu::Device::create());
    fmt::print("{}, {}; {} x {}, maps of {}\n\n", device.info().name, device.info().driver, settings.size, settings.size, settings.mapSize);
    culling->parsed() ? cullingTable(device, settings) : seamTable(device, settings);
    return 0;
}

} // namespace

} // namespace tegument

int main(int argc, char** argv) {
    return tegument::run(argc, argv);
}
