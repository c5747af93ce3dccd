#include "tests/d3d/cases.h"

#include "host/mesh/triangles.h"
#include "host/support/file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>

namespace tegument::test {

namespace fs = std::filesystem;

namespace {

/// With one chart.
Mesh sphere(float radius) {
    constexpr int kRings = 48;
    constexpr int kSectors = 96;
    Mesh mesh;
    mesh.name = "sphere";
    for (int ring = 0; ring <= kRings; ++ring)
        for (int sector = 0; sector <= kSectors; ++sector) {
            const float v = static_cast<float>(ring) / kRings;
            const float u = static_cast<float>(sector) / kSectors;
            const float theta = std::numbers::pi_v<float> * v;
            const float phi = 2 * std::numbers::pi_v<float> * u;
            mesh.positions.push_back(radius * glm::vec3(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)));
            mesh.uvs.emplace_back(u, v);
        }
    addGrid(mesh.indices, kSectors, kRings, "acbbcd");
    mesh.parts = {{.name = "sphere", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeBounds(mesh);
    computeNormals(mesh);
    computeTangents(mesh);
    return mesh;
}

constexpr int kTextureSize = 512;

/// The mean over squares of texels: what is tested is drawing, not filtering of large maps.
Image reduced(const Image& image) {
    const int factor = std::max(1, image.width / kTextureSize);
    if (factor == 1) return image;
    Image small{
        .width = image.width / factor, .height = image.height / factor, .channels = image.channels, .bitsPerChannel = image.bitsPerChannel};
    small.pixels.resize(static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height) *
                        static_cast<std::size_t>(small.channels));
    for (int y = 0; y < small.height * factor; ++y)
        for (int x = 0; x < small.width * factor; ++x)
            for (int channel = 0; channel < image.channels; ++channel)
                small.at(x / factor, y / factor, channel) += image.at(x, y, channel) / static_cast<float>(factor * factor);
    return small;
}

std::vector<fs::path> effectsIn(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(folder, code))
        if (entry.path().extension() == ".fx") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

bool computes(const Technique& technique) {
    return std::ranges::any_of(technique.passes, [](const Pass& pass) { return pass.computeShader.has_value(); });
}

std::vector<Case> discover() {
    std::vector<Case> cases;
    for (const fs::path& file : effectsIn("effects")) {
        const auto effect = loadCase({.effect = file});
        if (!effect) continue; // tests/effect and tests/check say why
        for (const Technique& technique : effect->techniques)
            for (const int bits : {16, 32})
                if (bits == 16 || file.stem() == "Convolution")
                    cases.push_back({.effect = file, .technique = technique.name, .mapBits = bits, .computes = computes(technique)});
    }
    for (const fs::path& file : effectsIn("effects/peers")) // the last technique of each: the others take fewer samples
        if (const auto effect = loadCase({.effect = file})) cases.push_back({file, effect->techniques.back().name});
    cases.push_back({.effect = "effects/Main.fx", .technique = "DEonLuebke", .lamps = 1});
    for (const char* technique : {"DEonLuebke", "Gosselin", "Lambert"})
        cases.push_back({.effect = "effects/Main.fx", .technique = technique, .lamps = 3, .surroundings = true});
    for (const auto& [effect, technique] :
         {std::pair{"effects/Pyramid.fx", "PyramidLinked"}, {"effects/peers/Preintegrated.fx", "PreintegratedPenumbra"}})
        cases.push_back({.effect = effect, .technique = technique, .lamps = 3, .surroundings = true});
    cases.push_back({.effect = "effects/Pyramid.fx", .technique = "Pyramid", .lamps = 3, .soft = true});
    for (const auto& [technique, computes] : {std::pair{"SkinPost", false}, {"SkinPostCompute", true}})
        cases.push_back({.effect = "effects/SkinPost.fx", .technique = technique, .computes = computes, .half = true});
    cases.push_back(libraryCase());
    return cases;
}

/// The library's client is compared with Main.fx.
std::string together(const Case& drawn) {
    return drawn.effect == libraryCase().effect ? "Main" : drawn.effect.stem().string();
}

/// Each effect goes where the fewest cases are, those with most techniques first.
std::map<std::string, int> deal() {
    std::map<std::string, int> techniques;
    for (const Case& drawn : allCases())
        ++techniques[together(drawn)];
    std::vector<std::pair<int, std::string>> effects;
    for (const auto& [name, count] : techniques)
        effects.emplace_back(-count, name);
    std::ranges::sort(effects);
    std::map<std::string, int> parts;
    std::array<int, kParts> filled{};
    for (const auto& [count, name] : effects) {
        const auto least = std::ranges::min_element(filled);
        *least -= count;
        parts[name] = static_cast<int>(least - filled.begin()) + 1;
    }
    return parts;
}

} // namespace

int partOf(const Case& drawn) {
    static const std::map<std::string, int> kDealt = deal();
    return kDealt.at(together(drawn));
}

std::string engineName(Engine engine) {
    constexpr std::array kNames = {"vulkan", "d3d9", "d3d10", "d3d11", "d3d12"};
    return kNames[static_cast<std::size_t>(engine)];
}

std::vector<std::pair<std::string, std::string>> Case::defines() const {
    std::vector<std::pair<std::string, std::string>> all = {
        {"TEGUMENT_MAP_SIZE", std::to_string(kMapSize)}, {"TEGUMENT_MAP_BITS", std::to_string(mapBits)}, {"TEGUMENT_RIBBON_ROWS", "128"}};
    if (lamps > 0) all.emplace_back("TEGUMENT_LAMPS", std::to_string(lamps));
    if (surroundings) all.emplace_back("TEGUMENT_SURROUNDINGS", "1");
    if (soft) all.emplace_back("TEGUMENT_SOFT_SHADOWS", "1");
    if (half) all.emplace_back("TEGUMENT_POST_HALF", "1");
    return all;
}

Result<Effect> loadCase(const Case& drawn) {
    return loadEffect(drawn.effect, {.defines = drawn.defines(), .includeFolders = drawn.includeFolders});
}

const Case& libraryCase() {
    static const Case drawn{.effect = "tests/library/Skin.fx", .technique = "Skin", .includeFolders = {drawings()}};
    return drawn;
}

bool drawnBy(const Case& drawn, Engine engine) {
    if (engine == Engine::Direct3D9 && drawn.soft) return false; // no slots for penumbras
    if (engine == Engine::Direct3D12) return !drawn.name().starts_with("Fur_Cube");
    return (drawn.effect != libraryCase().effect && !drawn.computes) || engine == Engine::Vulkan || engine == Engine::Direct3D11;
}

const std::vector<Case>& allCases() {
    static const std::vector<Case> cases = discover();
    return cases;
}

Result<Mesh> testMesh() {
    const fs::path human = cacheFolder() / "human" / "human.glb";
    std::error_code code;
    if (!fs::exists(human, code)) return sphere(100);
    auto mesh = loadMesh(human);
    if (!mesh) return mesh;
    for (EmbeddedTexture& texture : mesh->textures)
        texture.image = reduced(texture.image);
    return mesh;
}

Mesh ball() {
    return sphere(1);
}

Workspace testWorkspace() {
    Workspace workspace;
    workspace.camera.position = {1.75F, 0.35F, 3.7F};
    workspace.camera.target = {0, 0.17F, 0.1F};
    workspace.light.position = {-3.2F, 3.6F, 6};
    workspace.light.color = glm::vec3(1.7F);
    workspace.background = glm::vec3(2, 4, 6) / 255.0F;
    return workspace;
}

fs::path drawings() {
    return TEGUMENT_DRAWINGS;
}

fs::path drawing(const Case& drawn, Engine engine, const std::string& target) {
    return drawings() / (drawn.name() + "." + engineName(engine) + "." + target + ".f32");
}

fs::path statusFile(const Case& drawn, Engine engine) {
    return drawings() / (drawn.name() + "." + engineName(engine) + ".status");
}

fs::path missingFile() {
    return drawings() / "missing";
}

} // namespace tegument::test
