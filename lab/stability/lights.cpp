// Scenes with several lights and with surroundings, at the edges of what an effect may be given.

#include "host/image/dds.h"
#include "lab/reference/more_light.h"
#include "lab/stability/work.h"
#include "meshprep/light/environment.h"
#include "meshprep/light/occlusion.h"

#include <algorithm>
#include <cmath>

namespace tegument::bench::stability {

namespace {

constexpr std::size_t kMostLamps = 7; // beside the light of the workspace: eight lights

using reference::Lamp;

Lamp dark() {
    return {.colour = glm::dvec4(0)};
}

/// As many as the arrays of the effects hold: what is missing is dark.
void addLamps(HardScene& scene, std::vector<Lamp> lamps) {
    scene.defines.emplace_back("TEGUMENT_LAMPS", std::to_string(lamps.size()));
    lamps.resize(lamps.size() > 3 ? kMostLamps : 3, dark());
    scene.parameters.merge(reference::lampParameters(lamps));
}

HardScene lampScene(const std::string& name, const std::vector<Lamp>& lamps, bool soft) {
    HardScene scene = bodyScene();
    scene.name = name;
    addLamps(scene, lamps);
    if (soft) scene.defines.emplace_back("TEGUMENT_SOFT_SHADOWS", "1");
    return scene;
}

/// Of every kind, all around the body.
std::vector<Lamp> sevenLamps(double colour) {
    constexpr double kAway = 200;
    std::vector<Lamp> lamps(kMostLamps);
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const double turn = 0.9 * static_cast<double>(i);
        const glm::dvec3 from(std::sin(turn), 0.4, std::cos(turn));
        const bool near = i % 2 == 1;
        lamps[i].place = near ? glm::dvec4(kAway * from, 1) : glm::dvec4(from, 0);
        lamps[i].colour = glm::dvec4(glm::dvec3(colour), near ? kAway : 0.0);
        lamps[i].axis = glm::dvec4(-glm::normalize(from), near ? 20.0 : 0.2);
        if (i == 3) lamps[i].spot = {0.98, 0.95, 1, 1};
    }
    return lamps;
}

Lamp lampAt(const glm::dvec3& place, double radius) {
    return {.place = glm::dvec4(place, 1), .colour = {1, 1, 1, 100}, .axis = {0, 0, -1, radius}};
}

Lamp whiteLamp(const glm::dvec4& place, const glm::dvec4& axis, const glm::dvec4& spot = {-1, -2, 1, 1}) {
    return {.place = place, .colour = {1, 1, 1, 0}, .axis = axis, .spot = spot};
}

std::vector<HardScene> lampScenes() {
    const HardScene body = bodyScene();
    HardScene none = lampScene("lamps, and no light at all", {dark(), dark(), dark()}, false);
    none.workspace.light.color = glm::vec3(0);
    const glm::dvec3 vertex(body.mesh.positions[2000]);
    return {
        none,
        lampScene("eight lights", sevenLamps(1), false),
        lampScene("eight lights with penumbras", sevenLamps(1), true),
        lampScene("eight lights of 1e5", sevenLamps(1e5), true),
        lampScene("lamps inside the body, in its plane, on a vertex", {lampAt({0, 0, 1}, 1), lampAt({60, 0, 0}, 5), lampAt(vertex, 0)},
                  false),
        lampScene("wide lamps inside the body, in its plane, on a vertex",
                  {lampAt({0, 0, 1}, 1000), lampAt({60, 0, 0}, 70), lampAt(vertex, 10)}, true),
        lampScene("lamps 1 km away and of no direction",
                  {lampAt({3e5, 2e5, 9e5}, 1), whiteLamp(glm::dvec4(0), glm::dvec4(0)),
                   whiteLamp({0, 0, 200, 1}, glm::dvec4(0), {0.5, 0.5, 1, 1})},
                  true),
        lampScene("parallel lamps as wide as the sky, and of no width",
                  {whiteLamp({0, 0, 1, 0}, {0, 0, -1, 1}), whiteLamp({1, 1, 0, 0}, {0, 0, -1, 2}), whiteLamp({0, 1, 0, 0}, glm::dvec4(0))},
                  true)};
}

/// Black but for one pixel, in front above on the left.
Image onePixel(float radiance) {
    constexpr int kHeight = 64;
    Image image = plainImage(2 * kHeight, kHeight, 3);
    for (int c = 0; c < 3; ++c)
        image.at(90, 20, c) = radiance;
    return image;
}

} // namespace

Result<std::vector<HardScene>> litScenes(const std::filesystem::path& folder) {
    std::vector<HardScene> all = lampScenes();
    const auto environment = makeEnvironment(onePixel(1e6F), "one pixel of 1e6");
    if (!environment) return environment.error();
    HardScene bright = bodyScene();
    const auto occlusion = bakeOcclusion(bright.mesh, {.side = 64, .rays = 64});
    if (!occlusion) return occlusion.error();
    const auto put = [&](const char* parameter, const DdsTexture& texture) -> Result<void> {
        const auto file = folder / (std::string(parameter) + ".dds");
        bright.workspace.textures[parameter] = file.string();
        return writeDds(file, texture);
    };
    if (const auto written = put("gEnvironmentMap", *environment); !written) return written.error();
    if (const auto written = put("gOcclusionMap", makeDds(occlusion->map, DdsFormat::Rgba8, false)); !written) return written.error();
    bright.name = "surroundings with one pixel of 1e6";
    bright.defines = {{"TEGUMENT_SURROUNDINGS", "1"}};
    all.push_back(bright);
    bright.name = "the same, mirrored in skin of m = 0, with eight lights";
    bright.parameters = {{"gRoughness", {0}}, {"gSpecularIntensity", {1}}, {"gReflections", {4}}, {"gSurroundings", {4}}};
    addLamps(bright, sevenLamps(1));
    all.push_back(bright);
    return all;
}

bool knowsLightsOf(const Effect& effect, const HardScene& scene) {
    return std::ranges::any_of(scene.defines, [&](const auto& define) {
        return (define.first == "TEGUMENT_LAMPS" && effect.findParameter("gLampPlace")) ||
               (define.first == "TEGUMENT_SURROUNDINGS" && effect.findParameter("gEnvironmentMap"));
    });
}

} // namespace tegument::bench::stability
