#include "lab/bench/growth.h"

#include "generated/setting_names.h"
#include "lab/bench/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

namespace tegument::bench {

namespace {

/// What one size is drawn with.
struct Point {
    double x = 0; // the quantity
    int picture = 64;
    int mapSize = 64;
    int quads = 48; // of half a sphere's side
    std::map<std::string, std::vector<double>> parameters;
};

struct Sweep {
    std::string quantity;
    std::string what;
    std::string effect;
    std::string technique;
    std::string pass; // beginning of the names of the passes that count
    std::vector<Point> points;
};

/// Half of the picture is a sphere, lit from the upper right.
Scene sphereScene(int quads) {
    Scene scene{.name = "sphere", .mesh = sphere(20, quads)};
    computeTangents(scene.mesh);
    scene.workspace.head = false;
    scene.workspace.camera.position = {0, 0, 4.6F};
    scene.workspace.light.position = {4, 3, 4};
    return scene;
}

double timeOf(const Drawn& drawn, const std::string& pass) {
    double sum = 0;
    for (const PassTime& time : drawn.passes)
        if (time.name.starts_with(pass)) sum += time.milliseconds;
    return sum;
}

Contender contenderOf(const GrowthOptions& options, const Sweep& sweep, const Point& point) {
    return {.technique = sweep.technique,
            .setting = kSettingCorrected,
            .variant = fmt::format("{:.0f} {}", point.x, sweep.quantity),
            .effect = options.effects / sweep.effect,
            .defines = {{"TEGUMENT_SETTING", "2"}},
            .parameters = point.parameters};
}

/// All sizes in turns.
Result<Growth> measure(gpu::Device& device, const GrowthOptions& options, const Sweep& sweep, const Say& say) {
    std::deque<Scene> scenes;
    std::vector<Entry> entries;
    for (const Point& point : sweep.points) {
        const Scene& scene = scenes.emplace_back(sphereScene(point.quads));
        const Contest contest{
            .scene = scene, .width = point.picture, .height = point.picture, .mapSize = point.mapSize, .compiler = options.compiler};
        entries.push_back({contest, contenderOf(options, sweep, point)});
    }
    const auto drawn = drawInTurns(device, entries, options.frames, [&](const std::string& what) { say("growth: " + what); });
    Growth growth{.quantity = sweep.quantity, .what = sweep.what};
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        if (!drawn[i]) return drawn[i].error();
        growth.x.push_back(sweep.points[i].x);
        growth.milliseconds.push_back(timeOf(*drawn[i], sweep.pass));
    }
    const bool timed = std::ranges::all_of(growth.milliseconds, [](double ms) { return ms > 0; });
    if (!timed) return growth;
    growth.law = fitPowerLaw(growth.x, growth.milliseconds);
    growth.parts = fitAffine(growth.x, growth.milliseconds);
    return growth;
}

/// point(value) of each.
template <class ToPoint>
std::vector<Point> points(std::initializer_list<int> values, ToPoint point) {
    std::vector<Point> result;
    for (const int value : values)
        result.push_back(point(value));
    return result;
}

/// Of four sizes, each twice the one before.
template <class ToPoint>
std::vector<Point> doubled(int first, ToPoint point) {
    return points({first, 2 * first, 4 * first, 8 * first}, point);
}

double squared(int size) {
    return static_cast<double>(size) * size;
}

Sweep texels(int first) {
    return {.quantity = "texels of a map",
            .what = "ten convolutions of DEonLuebke",
            .effect = "Main.fx",
            .technique = "DEonLuebke",
            .pass = "Convolution",
            .points = doubled(first, [](int size) { return Point{.x = squared(size), .mapSize = size}; })};
}

Sweep pixels(int first) {
    return {.quantity = "pixels of the picture",
            .what = "last pass of DEonLuebke",
            .effect = "Main.fx",
            .technique = "DEonLuebke",
            .pass = "Final",
            .points = doubled(first, [](int size) { return Point{.x = squared(size), .picture = size, .mapSize = 256, .quads = 16}; })};
}

Sweep blurs(int mapSize) {
    return {.quantity = "passes",
            .what = "blurs of Gosselin",
            .effect = "Main.fx",
            .technique = "Gosselin",
            .pass = "Blur",
            .points = points({1, 2, 4, 6}, [&](double count) {
                return Point{.x = count, .mapSize = mapSize, .parameters = {{"gBlurCount", {count}}}};
            })};
}

Sweep layers(int picture) {
    return {.quantity = "layers of fur",
            .what = "shells of Fur",
            .effect = "Fur.fx",
            .technique = "CubePosition",
            .pass = "Shells",
            .points = points({8, 16, 32, 64}, [&](double count) {
                return Point{.x = count, .picture = picture, .parameters = {{"gFurLayers", {count}}}};
            })};
}

Sweep faces(int first) {
    return {.quantity = "faces of the mesh",
            .what = "shadow map of Gosselin, 64 x 64 texels",
            .effect = "Main.fx",
            .technique = "Gosselin",
            .pass = "ShadowMap",
            .points = doubled(first, [](int quads) { return Point{.x = 4 * squared(quads), .quads = quads}; })};
}

} // namespace

Result<std::vector<Growth>> measureGrowth(gpu::Device& device, const GrowthOptions& options, const Say& say) {
    const auto size = [&](int large, int usual, int small) { return options.large ? large : options.small ? small : usual; };
    std::vector<Sweep> sweeps = {texels(size(512, 128, 16)), pixels(size(512, 128, 16)), blurs(size(2048, 256, 32))};
    std::error_code code;
    if (std::filesystem::exists(options.effects / "Fur.fx", code)) sweeps.push_back(layers(size(1024, 128, 16)));
    sweeps.push_back(faces(size(256, 64, 8)));
    std::vector<Growth> all;
    for (const Sweep& sweep : sweeps) {
        auto growth = measure(device, options, sweep, say);
        if (!growth) return growth.error();
        all.push_back(std::move(*growth));
    }
    return all;
}

} // namespace tegument::bench
