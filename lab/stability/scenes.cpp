// What the stability report draws: scenes at the edges of what an effect may be given.

#include "lab/bench/patch.h"
#include "lab/reference/surface.h"
#include "lab/stability/work.h"
#include "lab/verify/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace tegument::bench::stability {

namespace {

constexpr double kPi = std::numbers::pi;

void finish(Mesh& mesh) {
    mesh.parts = {{.name = mesh.name, .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    if (mesh.normals.empty()) computeNormals(mesh);
    if (mesh.tangents.empty()) computeTangents(mesh);
    computeBounds(mesh);
}

Workspace stage(const glm::vec3& camera, const glm::vec3& light) {
    Workspace workspace = worldWorkspace();
    workspace.camera.position = camera;
    workspace.camera.target = glm::vec3(0);
    workspace.light.position = light;
    workspace.light.color = {1.5F, 1.2F, 1.0F};
    return workspace;
}

Image constant(const glm::vec4& value) {
    Image image{.width = 2, .height = 2, .channels = 4, .bitsPerChannel = 16};
    for (int i = 0; i < 4; ++i)
        for (int c = 0; c < 4; ++c)
            image.pixels.push_back(value[c]);
    return image;
}

using Chart = std::function<glm::dvec2(double, double)>;

/// A sheet of 60 x 60 mm, bent like a quarter of a pipe, under a chart; `quads` a side.
Mesh sheet(const std::string& name, const Chart& chart, int quads = 32) {
    constexpr double kRadius = 40;
    constexpr double kHeight = 60;
    const auto turn = [](double s) { return (s - 0.5) * 1.5; };
    Mesh mesh;
    mesh.name = name;
    addPatch(mesh, {.position =
                        [=](double s, double t) {
                            return glm::dvec3(kRadius * std::sin(turn(s)), kHeight * (0.5 - t), kRadius * (std::cos(turn(s)) - 0.8));
                        },
                    .normal = [=](double s, double) { return glm::dvec3(std::sin(turn(s)), 0, std::cos(turn(s))); },
                    .uv = chart,
                    .columns = quads,
                    .rows = quads});
    finish(mesh);
    return mesh;
}

HardScene sheetScene(const std::string& name, const Chart& chart) {
    return {name, sheet(name, chart), stage({20, 15, 170}, {-200, 150, 300}), {}};
}

struct NamedChart {
    const char* name;
    Chart chart;
};

std::vector<NamedChart> hardCharts() {
    const auto stepped = [](double s, double t) {
        const double steps = 8;
        const double whole = std::floor(s * steps + 1e-9);
        const double within = std::min(1.0, (s * steps - whole) / 0.75);
        return glm::dvec2(0.05 + 0.9 * (whole + within) / steps, 0.05 + 0.9 * t);
    };
    std::vector<NamedChart> charts;
    charts.push_back({"chart as large as the sheet", square(glm::dvec2(0.05), 0.9)});
    charts.push_back({"stretched 16 : 1", rectangle({0.05, 0.45}, {0.9, 0.056})});
    charts.push_back({"stretched 1 : 100", rectangle({0.45, 0.02}, {0.0096, 0.96})});
    charts.push_back({"chart of a tenth of the map", square(glm::dvec2(0.45), 0.1)});
    charts.push_back({"mirrored", rectangle({0.95, 0.05}, {-0.9, 0.9})});
    charts.push_back({"sheared by 45 degrees", [](double s, double t) { return glm::dvec2(0.05 + 0.45 * (s + t), 0.275 + 0.45 * t); }});
    charts.push_back({"stretch from 1 to 19 across the chart",
                      [](double s, double t) { return glm::dvec2(0.05 + 0.9 * (0.1 * s + 0.9 * s * s), 0.05 + 0.9 * t); }});
    charts.push_back({"every fourth column without area", stepped});
    return charts;
} // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks): a std::function owns what it was given

/// White right of the plane's middle, black left of it, wherever the chart puts them; the nearest covered texel fills the gaps.
Image edgeMap(const Mesh& mesh) {
    constexpr int kSize = 1024;
    constexpr int kGap = 4;
    const reference::Unwrapped charts = reference::unwrap(mesh, kSize);
    Image image{.width = kSize, .height = kSize, .channels = 4, .bitsPerChannel = 8};
    image.pixels.assign(std::size_t{4} * kSize * kSize, 0.0F);
    const auto nearest = [&](int x, int y) -> const reference::Place* {
        for (int away = 0; away <= kGap; ++away)
            for (int j = std::max(0, y - away); j <= std::min(kSize - 1, y + away); ++j)
                for (int i = std::max(0, x - away); i <= std::min(kSize - 1, x + away); ++i)
                    if (const auto& place = charts.at(i, j)) return &*place;
        return nullptr;
    };
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            image.at(x, y, 3) = 1;
            const reference::Place* place = nearest(x, y);
            if (!place || reference::interpolate(mesh, *place).position.x < 0) continue;
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = 1;
        }
    return image;
}

/// A plane of 60 x 60 mm, lit from straight above, white right of x = 0. All colour is taken before diffusion: an edge of light.
HardScene edgeScene(const NamedChart& chart) {
    HardScene scene{chart.name, {}, stage({0, 0, 200}, {0, 0, 1e5F}), {{"gMix", {1}}, {"gSpecularIntensity", {0}}}};
    scene.workspace.light.color = glm::vec3(1);
    scene.mesh.name = chart.name;
    addPatch(scene.mesh, {.position = [](double s, double t) { return glm::dvec3(60 * s - 30, 30 - 60 * t, 0); },
                          .normal = [](double, double) { return glm::dvec3(0, 0, 1); },
                          .uv = chart.chart,
                          .columns = 32,
                          .rows = 32});
    finish(scene.mesh);
    scene.mesh.textures = {{.role = "color", .image = edgeMap(scene.mesh)}};
    return scene;
}

HardScene with(HardScene scene, const std::string& name, const std::function<void(HardScene&)>& change) {
    scene.name = name;
    change(scene);
    return scene;
}

HardScene withTexture(const std::string& name, const std::string& role, const glm::vec4& value) {
    return with(bodyScene(), name, [&](HardScene& scene) {
        std::erase_if(scene.mesh.textures, [&](const EmbeddedTexture& texture) { return texture.role == role; });
        scene.mesh.textures.push_back({.role = role, .image = constant(value)});
    });
}

HardScene withParameters(const std::string& name, const Numbers& parameters) {
    return with(bodyScene(), name, [&](HardScene& scene) { scene.parameters = parameters; });
}

/// A light or an eye where the pyramids that are fitted to the mesh have to give way.
void addPlaces(std::vector<HardScene>& all) {
    const auto place = [&](const char* name, auto&& change) { all.push_back(with(bodyScene(), name, change)); };
    place("light in the plane of the body", [](HardScene& s) { s.workspace.light.position = {500, 0, 0}; });
    place("light behind", [](HardScene& s) { s.workspace.light.position = {0, 50, -500}; });
    place("light inside the body", [](HardScene& s) { s.workspace.light.position = {0, 0, 1}; });
    place("light on a vertex", [](HardScene& s) { s.workspace.light.position = s.mesh.positions[2000]; });
    place("light above, along the up vector", [](HardScene& s) { s.workspace.light.position = {0, 500, 0}; });
    place("light 1 km away", [](HardScene& s) { s.workspace.light.position = {-3e5F, 2e5F, 9e5F}; });
    place("no light", [](HardScene& s) { s.workspace.light.color = glm::vec3(0); });
    place("light of 1e5", [](HardScene& s) { s.workspace.light.color = glm::vec3(1e5F); });
    place("light of 1e-6", [](HardScene& s) { s.workspace.light.color = glm::vec3(1e-6F); });
    place("eye in the plane of the body", [](HardScene& s) { s.workspace.camera.position = {200, 0, 0}; });
    place("eye inside the body", [](HardScene& s) {
        s.workspace.camera.position = {0, 5, 1};
        s.workspace.camera.target = {0, 40, 1};
    });
    place("eye on a vertex", [](HardScene& s) { s.workspace.camera.position = s.mesh.positions[2000]; });
    place("eye 1 km away, 1 degree", [](HardScene& s) {
        s.workspace.camera.position = {0, 0, 1e6F};
        s.workspace.camera.horizontalFov = 1;
    });
    place("view of 170 degrees", [](HardScene& s) {
        s.workspace.camera.position = {0, 0, 30};
        s.workspace.camera.horizontalFov = 170;
    });
    place("light behind the eye's target, L = -V", [](HardScene& s) {
        s.workspace.camera.position = {60, 20, 170};
        s.workspace.light.position = {-180, -60, -510};
    });
}

void addParameters(std::vector<HardScene>& all) {
    const std::vector<double> none(24, 0);
    for (const double m : {0.0, 1e-3, 1.0})
        all.push_back(
            withParameters(fmt::format("m = {:g}, rho_s = 1", m),
                           {{"gRoughness", {m}}, {"gPlainRoughness", {m}}, {"gSpecularIntensity", {1}}, {"gPlainIntensity", {1}}}));
    all.push_back(withParameters("mix 0", {{"gMix", {0}}}));
    all.push_back(withParameters("mix 1", {{"gMix", {1}}}));
    all.push_back(withParameters("tolerance 0", {{"gShadowTolerance", {0}}}));
    all.push_back(withParameters("tolerance 1e6", {{"gShadowTolerance", {1e6}}}));
    std::vector<double> widest(24, 1.0 / 6);
    for (std::size_t i = 3; i < widest.size(); i += 4)
        widest[i] = 1e6;
    all.push_back(withParameters("every variance 1e6 mm^2", {{"gGaussianWeight", widest}}));
    all.push_back(withParameters("every weight and variance 0", {{"gGaussianWeight", none}}));
    all.push_back(withParameters("blurs of 0 mm", {{"gBlurSize", {0}}}));
    all.push_back(withParameters("blurs of 1e4 mm", {{"gBlurSize", {1e4}}, {"gBlurCount", {6}}}));
    all.push_back(withParameters("fur of length 0, one layer", {{"gFurLength", {0}}, {"gFurLayers", {1}}}));
    all.push_back(withParameters("fur of length 100, leaning", {{"gFurLength", {100}}, {"gFurLean", {1}}, {"gFurLayers", {4}}}));
    all.push_back(withParameters("fur exponent 1e4", {{"gFurExponent", {1e4}}, {"gFurLayers", {4}}, {"gFurDensity", {0}}}));
}

void addCharts(std::vector<HardScene>& all) {
    all.push_back(sheetScene("all texture coordinates equal", [](double, double) { return glm::dvec2(0.5); }));
    all.push_back(sheetScene("texture coordinates on a line", [](double s, double t) { return glm::dvec2(0.2 + 0.3 * (s + t)); }));
    all.push_back(
        sheetScene("texture coordinates outside the square", [](double s, double t) { return glm::dvec2(4 * s - 2, 4 * t - 2); }));
    all.push_back(sheetScene("chart within one texel", [](double s, double t) { return 0.5 + 1e-3 * glm::dvec2(s, t); }));
    for (HardScene& scene : chartScenes())
        all.push_back(std::move(scene));
}

/// Needles, triangles without area, normals and tangents of length 0.
HardScene brokenMesh() {
    HardScene scene = sheetScene("needles, triangles without area, zero normals", [](double s, double t) { return glm::dvec2(s, t); });
    Mesh& mesh = scene.mesh;
    for (std::size_t i = 0; i < mesh.positions.size(); i += 7)
        mesh.positions[i] = mesh.positions[(i + 1) % mesh.positions.size()];
    for (std::size_t i = 0; i < mesh.normals.size(); i += 11)
        mesh.normals[i] = glm::vec3(0);
    for (std::size_t i = 0; i < mesh.tangents.size(); i += 13)
        mesh.tangents[i] = glm::vec4(0);
    return scene;
}

HardScene oneTriangle() {
    HardScene scene{"a single triangle", {}, stage({0, 0, 100}, {100, 100, 200}), {}};
    scene.mesh.name = scene.name;
    scene.mesh.positions = {{-20, -20, 0}, {20, -20, 0}, {0, 20, 0}};
    scene.mesh.normals.assign(3, {0, 0, 1});
    scene.mesh.uvs = {{0.1F, 0.9F}, {0.9F, 0.9F}, {0.5F, 0.1F}};
    scene.mesh.indices = {0, 1, 2};
    finish(scene.mesh);
    return scene;
}

} // namespace

HardScene bodyScene() {
    HardScene scene{"the built-in body", verificationMesh(), stage({60, 25, 170}, {-330, 280, 420}), {}};
    scene.workspace.camera.target = {0, 0, 2};
    scene.workspace.camera.horizontalFov = 30;
    return scene;
}

HardScene scaled(HardScene scene, double factor) {
    const auto by = static_cast<float>(factor);
    for (glm::vec3& position : scene.mesh.positions)
        position *= by;
    computeBounds(scene.mesh);
    scene.workspace.camera.position *= by;
    scene.workspace.camera.target *= by;
    scene.workspace.light.position *= by;
    scene.name += fmt::format(", radius {:.0e} mm", static_cast<double>(scene.mesh.bounds.radius));
    return scene;
}

HardScene capScene(double radius, double degrees, const glm::dvec3& toEye, const glm::dvec3& toLight) {
    const double reach = degrees * kPi / 180;
    // Squares to discs without a pole: the larger coordinate is the ring.
    const auto direction = [=](double s, double t) {
        const glm::dvec2 p(2 * s - 1, 1 - 2 * t);
        const double ring = std::max(std::abs(p.x), std::abs(p.y));
        const double length = glm::length(p);
        const glm::dvec2 round = length > 0 ? p * (ring / length) : p;
        const double r = glm::length(round);
        const double sine = r > 0 ? std::sin(reach * r) / r : reach;
        return glm::dvec3(sine * round, std::cos(reach * r));
    };
    HardScene scene{
        fmt::format("cap of {:g} degrees", degrees), {}, stage(glm::vec3(toEye * (8 * radius)), glm::vec3(toLight * (20 * radius))), {}};
    scene.workspace.camera.horizontalFov = static_cast<float>(glm::degrees(2 * std::atan(1.1 * std::sin(reach) / (8 - std::cos(reach)))));
    scene.workspace.camera.target = glm::vec3(0, 0, static_cast<float>(degrees < 45 ? radius : 0));
    scene.workspace.light.color = glm::vec3(1);
    if (std::abs(toEye.y) > 0.9) scene.workspace.camera.up = {0, 0, 1};
    scene.mesh.name = scene.name;
    addPatch(scene.mesh, {.position = [=](double s, double t) { return radius * direction(s, t); },
                          .normal = direction,
                          .uv = square(glm::dvec2(0.05), 0.9),
                          .columns = 96,
                          .rows = 96});
    finish(scene.mesh);
    return scene;
}

std::vector<HardScene> chartScenes() {
    std::vector<HardScene> all;
    for (const NamedChart& chart : hardCharts())
        all.push_back(sheetScene(chart.name, chart.chart));
    return all;
}

std::vector<HardScene> edgeScenes() {
    std::vector<HardScene> all;
    for (const NamedChart& chart : hardCharts())
        all.push_back(edgeScene(chart));
    return all;
}

HardScene wallScene() {
    HardScene scene{"wall on a floor", {}, stage({0, 300, 10}, {0, 400, -400}), {}};
    scene.workspace.camera.target = {0, 0, 10};
    scene.workspace.camera.up = {0, 0, -1};
    scene.workspace.camera.horizontalFov = 6;
    scene.workspace.light.color = glm::vec3(1);
    scene.mesh.name = scene.name;
    addPatch(scene.mesh, {.position = [](double s, double t) { return glm::dvec3(80 * s - 40, 0, 80 * t - 40); },
                          .normal = [](double, double) { return glm::dvec3(0, 1, 0); },
                          .uv = square(glm::dvec2(0.02), 0.5),
                          .columns = 8,
                          .rows = 8});
    addPatch(scene.mesh, {.position = [](double s, double t) { return glm::dvec3(80 * s - 40, 30 * t, 0); },
                          .normal = [](double, double) { return glm::dvec3(0, 0, 1); },
                          .uv = rectangle({0.02, 0.6}, {0.5, 0.2}),
                          .columns = 8,
                          .rows = 4});
    finish(scene.mesh);
    return scene;
}

std::vector<HardScene> hostileScenes() {
    std::vector<HardScene> all = {bodyScene()};
    for (const double radius : {1e-4, 1e6})
        all.push_back(scaled(bodyScene(), radius / static_cast<double>(bodyScene().mesh.bounds.radius)));
    addPlaces(all);
    addParameters(all);
    addCharts(all);
    all.push_back(brokenMesh());
    all.push_back(oneTriangle());
    all.push_back(withTexture("black colour map", "color", {0, 0, 0, 1}));
    all.push_back(withTexture("colour map without skin", "color", {0.5F, 0.5F, 0.5F, 0}));
    all.push_back(withTexture("normal map of zero vectors", "normal", {0.5F, 0.5F, 0.5F, 1}));
    all.push_back(withTexture("normal map that points inwards", "normal", {0.5F, 0.5F, 0, 1}));
    all.push_back(withTexture("kernel size 0", "kernelSize", {0, 0, 0, 1}));
    all.push_back(withTexture("kernel size 1", "kernelSize", {1, 1, 1, 1}));
    return all;
}

} // namespace tegument::bench::stability
