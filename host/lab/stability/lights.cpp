// Scenes with several lights and with surroundings, at the edges of what an effect may be given.

#include "host/image/dds.h"
#include "host/lab/stability/work.h"
#include "meshprep/light/environment.h"
#include "meshprep/light/occlusion.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace tegument::bench::stability {

namespace {

constexpr std::size_t kMostLamps = 7; // beside the light of the workspace: eight lights

struct HardLamp {
    glm::vec4 place{0, 0, 1, 0};
    glm::vec4 colour{1, 1, 1, 0};
    glm::vec4 axis{0, 0, -1, 0.1F};
    glm::vec4 spot{-1, -2, 1, 1};
};

/// One behind the other: as many as the arrays of the effects hold; what is missing is dark.
void addLamps(HardScene& scene, std::vector<HardLamp> lamps) {
    scene.defines.emplace_back("TEGUMENT_LAMPS", std::to_string(lamps.size()));
    HardLamp dark;
    dark.colour = glm::vec4(0);
    lamps.resize(lamps.size() > 3 ? kMostLamps : 3, dark);
    for (const HardLamp& lamp : lamps)
        for (const auto& [name, value] : {std::pair("gLampPlace", lamp.place), std::pair("gLampColor", lamp.colour),
                                          std::pair("gLampAxis", lamp.axis), std::pair("gLampSpot", lamp.spot)})
            scene.parameters[name].insert(scene.parameters[name].end(), glm::value_ptr(value), glm::value_ptr(value) + 4);
}

HardScene lampScene(const std::string& name, const std::vector<HardLamp>& lamps, bool soft) {
    HardScene scene = bodyScene();
    scene.name = name;
    addLamps(scene, lamps);
    if (soft) scene.defines.emplace_back("TEGUMENT_SOFT_SHADOWS", "1");
    return scene;
}

/// Of every kind, all around the body.
std::vector<HardLamp> sevenLamps(float colour) {
    std::vector<HardLamp> lamps(kMostLamps);
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const float turn = 0.9F * static_cast<float>(i);
        const bool near = i % 2 == 1;
        lamps[i].place = glm::vec4((near ? 200.0F : 1.0F) * glm::vec3(std::sin(turn), 0.4F, std::cos(turn)), near ? 1.0F : 0.0F);
        lamps[i].colour = glm::vec4(glm::vec3(colour), near ? 200.0F : 0.0F);
        lamps[i].axis = glm::vec4(-glm::vec3(lamps[i].place) / (near ? 200.0F : 1.0F), near ? 20.0F : 0.2F);
        if (i == 3) lamps[i].spot = {0.98F, 0.95F, 1, 1};
    }
    return lamps;
}

HardLamp lampAt(const glm::vec3& place, float radius) {
    HardLamp lamp;
    lamp.place = glm::vec4(place, 1);
    lamp.colour = {1, 1, 1, 100};
    lamp.axis.w = radius;
    return lamp;
}

HardLamp withAxis(const glm::vec4& place, const glm::vec4& axis, const glm::vec4& spot) {
    HardLamp lamp;
    lamp.place = place;
    lamp.axis = axis;
    lamp.spot = spot;
    return lamp;
}

std::vector<HardScene> lampScenes() {
    const HardScene body = bodyScene();
    HardLamp dark;
    dark.colour = glm::vec4(0);
    HardScene none = lampScene("lamps, and no light at all", {dark, dark, dark}, false);
    none.workspace.light.color = glm::vec3(0);
    const glm::vec3 vertex = body.mesh.positions[2000];
    return {none,
            lampScene("eight lights", sevenLamps(1), false),
            lampScene("eight lights with penumbras", sevenLamps(1), true),
            lampScene("eight lights of 1e5", sevenLamps(1e5F), true),
            lampScene("lamps inside the body, in its plane, on a vertex", {lampAt({0, 0, 1}, 1), lampAt({60, 0, 0}, 5), lampAt(vertex, 0)},
                      false),
            lampScene("wide lamps inside the body, in its plane, on a vertex",
                      {lampAt({0, 0, 1}, 1000), lampAt({60, 0, 0}, 70), lampAt(vertex, 10)}, true),
            lampScene("lamps 1 km away and of no direction",
                      {lampAt({3e5F, 2e5F, 9e5F}, 1), withAxis(glm::vec4(0), glm::vec4(0), {-1, -2, 1, 1}),
                       withAxis({0, 0, 200, 1}, glm::vec4(0), {0.5F, 0.5F, 1, 1})},
                      true),
            lampScene("parallel lamps as wide as the sky, and of no width",
                      {withAxis({0, 0, 1, 0}, {0, 0, -1, 1}, {-1, -2, 1, 1}), withAxis({1, 1, 0, 0}, {0, 0, -1, 2}, {-1, -2, 1, 1}),
                       withAxis({0, 1, 0, 0}, glm::vec4(0), {-1, -2, 1, 1})},
                      true)};
}

/// Black but for one pixel, in front above on the left.
Image onePixel(float radiance) {
    constexpr int kHeight = 64;
    Image image{.width = 2 * kHeight, .height = kHeight, .channels = 3, .pixels = {}};
    image.pixels.assign(std::size_t{6} * kHeight * kHeight, 0.0F);
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
