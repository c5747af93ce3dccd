#include "lab/bench/light_set.h"

#include "host/support/file.h"
#include "lab/bench/scenes.h"
#include "meshprep/light/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <string_view>

namespace tegument::bench {

namespace fs = std::filesystem;

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

/// Nothing where the file is missing or has another length: both are computed.
bool readInto(const fs::path& file, std::vector<glm::dvec3>& light, std::size_t first, std::size_t last) {
    std::error_code code;
    if (!fs::exists(file, code)) return false;
    const auto bytes = readFile(file);
    if (!bytes || bytes->size() != (last - first) * sizeof(glm::dvec3)) return false;
    std::memcpy(&light[first], bytes->data(), bytes->size());
    return true;
}

std::string_view bytesOf(const std::vector<glm::dvec3>& light) {
    return {reinterpret_cast<const char*>(light.data()), light.size() * sizeof(glm::dvec3)};
}

bool readNumber(std::string_view text, std::size_t& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

} // namespace

const std::vector<std::string>& lightSetNames() {
    static const std::vector<std::string> kNames = {kKeyAlone, "lamps", "surroundings", "both"};
    return kNames;
}

LightSet lightSet(const std::string& name) {
    LightSet set{.name = name, .defines = {}};
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

Result<Part> partOf(const std::string& text) {
    const std::size_t slash = text.find('/');
    Part part;
    if (slash != std::string::npos && readNumber(std::string_view(text).substr(0, slash), part.index) &&
        readNumber(std::string_view(text).substr(slash + 1), part.count) && part.index >= 1 && part.index <= part.count)
        return part;
    return usageError(8101, fmt::format("'{}' is no part", text), "parts count from 1: 1/8 is the first of eight");
}

Result<std::vector<glm::dvec3>> keptLight(const KeptLight& kept, std::size_t count, const ComputeLight& compute) {
    if (kept.folder.empty() || count < kKeptFrom) return compute(0, count);
    std::vector<glm::dvec3> light(count, glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
    for (std::size_t first = 0; first < count; first += kKeptTogether) {
        const std::size_t last = std::min(first + kKeptTogether, count);
        const std::size_t file = first / kKeptTogether;
        const fs::path path = kept.folder / kept.key / fmt::format("{:05}.f64", file);
        if (readInto(path, light, first, last)) continue;
        if (file % kept.part.count != kept.part.index - 1) continue;
        const std::vector<glm::dvec3> computed = compute(first, last);
        std::ranges::copy(computed, light.begin() + static_cast<std::ptrdiff_t>(first));
        if (auto written = writeFile(path, bytesOf(computed)); !written) return written.error();
    }
    return light;
}

} // namespace tegument::bench
