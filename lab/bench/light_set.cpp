#include "lab/bench/light_set.h"

#include "lab/bench/scenes.h"
#include "meshprep/light/environment.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::bench {

namespace {

/// Pieces of the sky in each half turn: 288 for what enters, a cosine over 14 degrees; for what is mirrored 3,200, over 4.
constexpr int kDiffuseRows = 12;
constexpr int kSpecularRows = 40;
constexpr double kStudioBesideLamps = 0.35;

/// A fill from the left in front, a rim from the right behind and one from the left behind, parallel (docs/settings.md).
std::vector<reference::Lamp> portraitLamps() {
    return {{.place = {0.85, 0.1, 0.5, 0}, .colour = {0.25, 0.27, 0.30, 0}},
            {.place = {-0.7, 0.45, -0.55, 0}, .colour = {0.14, 0.15, 0.16, 0}},
            {.place = {0.6, 0.5, -0.65, 0}, .colour = {0.12, 0.12, 0.12, 0}}};
}

void addLamps(LightSet& set) {
    set.more.lamps = portraitLamps();
    set.defines.emplace_back("TEGUMENT_LAMPS", std::to_string(set.more.lamps.size()));
    set.parameters.merge(reference::lampParameters(set.more.lamps));
}

void addStudio(LightSet& set, double share) {
    set.defines.emplace_back("TEGUMENT_SURROUNDINGS", "1");
    set.parameters["gSurroundings"] = {share};
    const Image studio = defaultEnvironment(DefaultEnvironment::Studio);
    set.more.diffuseSky = reference::skyPieces(studio, kDiffuseRows);
    set.more.specularSky = reference::skyPieces(studio, kSpecularRows);
    for (auto* sky : {&set.more.diffuseSky, &set.more.specularSky})
        for (reference::SkyPiece& piece : *sky)
            piece.light *= share;
}

} // namespace

const std::vector<std::string>& lightSetNames() {
    static const std::vector<std::string> kNames = {kKeyAlone, "lamps", "surroundings", "both"};
    return kNames;
}

LightSet lightSet(const std::string& name) {
    LightSet set{.name = name};
    if (name == "lamps" || name == "both") addLamps(set);
    if (name == "surroundings") {
        addStudio(set, 1);
        set.key = 0;
    }
    if (name == "both") addStudio(set, kStudioBesideLamps);
    return set;
}

void lightBy(Scene& scene, const LightSet& lights) {
    scene.lights = lights;
    scene.workspace.light.color *= static_cast<float>(lights.key);
    for (const auto& [name, values] : lights.parameters)
        scene.workspace.parameters[name] = values;
}

} // namespace tegument::bench
