#include "lab/verify/fur_scene.h"

#include "generated/setting_names.h"
#include "host/mesh/triangles.h"
#include "lab/verify/work.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace tegument::verify {

namespace {

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

/// A surface over the unit square, closed along u; counter-clockwise from outside where d/du x d/dv points outwards.
Mesh surface(const char* name, int alongU, int alongV, const std::function<glm::vec3(float, float)>& at) {
    Mesh mesh;
    mesh.name = name;
    for (int j = 0; j <= alongV; ++j)
        for (int i = 0; i <= alongU; ++i) {
            const glm::vec2 uv(static_cast<float>(i) / static_cast<float>(alongU), static_cast<float>(j) / static_cast<float>(alongV));
            mesh.positions.push_back(at(uv.x, uv.y));
            mesh.uvs.push_back(uv);
        }
    addGrid(mesh.indices, static_cast<std::uint32_t>(alongU), static_cast<std::uint32_t>(alongV), "abdadc");
    mesh.parts = {{.name = name, .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    return mesh;
}

void finish(Mesh& mesh) {
    computeTangents(mesh);
    computeBounds(mesh);
}

} // namespace

Mesh verificationTorus(int around, int across) {
    constexpr float kRadius = 60; // mm
    constexpr float kThickness = 22;
    const auto normal = [](float u, float v) {
        return glm::vec3(std::cos(kTurn * v) * std::cos(kTurn * u), std::sin(kTurn * v), -std::cos(kTurn * v) * std::sin(kTurn * u));
    };
    Mesh mesh = surface("torus", around, across, [&](float u, float v) {
        return kRadius * glm::vec3(std::cos(kTurn * u), 0, -std::sin(kTurn * u)) + kThickness * normal(u, v);
    });
    for (const glm::vec2& uv : mesh.uvs)
        mesh.normals.push_back(normal(uv.x, uv.y));
    finish(mesh);
    return mesh;
}

Mesh verificationBall(int around, int down) {
    constexpr float kRadius = 80; // mm
    const auto normal = [](float u, float v) {
        const float theta = kTurn / 2 * (1 - v);
        return glm::vec3(std::sin(theta) * std::cos(kTurn * u), std::cos(theta), -std::sin(theta) * std::sin(kTurn * u));
    };
    Mesh mesh = surface("ball", around, down, [&](float u, float v) { return kRadius * normal(u, v); });
    for (const glm::vec2& uv : mesh.uvs)
        mesh.normals.push_back(normal(uv.x, uv.y));
    finish(mesh);
    return mesh;
}

namespace {

Mesh torus() {
    return verificationTorus(96, 40);
}

Mesh ball() {
    return verificationBall(96, 48);
}

FurScene sceneWith(const VerifyOptions& options, Mesh (*make)(), const char* name) {
    FurScene scene{.name = name};
    scene.coat = {.layers = 12, .length = 0.08, .lean = 0.5, .spread = 0.8, .taper = 1, .softness = 0.5, .fill = {0.05, 0.1, 0.15}};
    scene.coat.kajiyaKay = options.setting == kSettingSeed ? 0 : 1;
    scene.coat.fringes = options.setting == kSettingCorrected;
    if (options.mesh && options.workspace) {
        scene.scene = {*options.mesh, *options.workspace};
        scene.name = options.mesh->name;
        return scene;
    }
    scene.scene.mesh = make();
    Workspace& workspace = scene.scene.workspace;
    workspace.head = false;
    workspace.camera.position = {0.4F, 2.6F, 3.6F};
    workspace.light.position = {-3, 5, 3};
    workspace.light.color = {1.5F, 1.2F, 1.0F};
    workspace.background = {0.02F, 0.03F, 0.04F};
    return scene;
}

/// An integer hash (Wang's), in 0..1.
double random(std::uint32_t key) {
    key = (key ^ 61U) ^ (key >> 16U);
    key *= 9U;
    key ^= key >> 4U;
    key *= 0x27d4eb2dU;
    key ^= key >> 15U;
    return static_cast<double>(key) / 4294967295.0;
}

} // namespace

FurScene furTorus(const VerifyOptions& options) {
    return sceneWith(options, torus, "torus");
}

FurScene furAfar(const VerifyOptions& options) {
    FurScene scene = furTorus(options);
    scene.name += ", from afar";
    scene.coat.deviation = 0.15;
    scene.coat.grain = 0.02;
    return scene;
}

FurScene furBefore(const VerifyOptions& options) {
    FurScene scene = furTorus(options);
    scene.name += ", a coat before a coat";
    scene.coat.fringes = true;
    scene.scene.workspace.camera.position = {0.4F, 1.2F, 4.2F};
    return scene;
}

FurScene furBall(const VerifyOptions& options) {
    FurScene scene = sceneWith(options, ball, "ball");
    scene.name += ", outer layers first";
    scene.coat.outerFirst = true;
    return scene;
}

std::map<std::string, std::vector<double>> parametersOf(const reference::FurCoat& coat) {
    return {{"gFurLayers", {static_cast<double>(coat.layers)}},
            {"gFurLength", {coat.length}},
            {"gFurLean", {coat.lean}},
            {"gFurSpread", {coat.spread}},
            {"gFurTaper", {coat.taper}},
            {"gFurSoftness", {coat.softness}},
            {"gFurAlphaTest", {coat.alphaTest}},
            {"gFurDeviation", {coat.deviation}},
            {"gFurGrain", {coat.grain}},
            {"gFurOuterFirst", {coat.outerFirst ? 1.0 : 0.0}},
            {"gFurFringes", {coat.fringes ? 1.0 : 0.0}},
            {"gFurFill", {coat.fill.x, coat.fill.y, coat.fill.z}}};
}

Image furPattern(int size, int seed) {
    constexpr int kCell = 4; // texels
    constexpr double kRadius = 3;
    Image image = plainImage(size, size, 4);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            double height = 0;
            for (int j = y / kCell - 1; j <= y / kCell + 1; ++j)
                for (int i = x / kCell - 1; i <= x / kCell + 1; ++i) {
                    const auto key = static_cast<std::uint32_t>(((seed * 131 + j + 1) * 131 + i + 1) * 3);
                    const glm::dvec2 root = static_cast<double>(kCell) * (glm::dvec2(i, j) + glm::dvec2(random(key), random(key + 1)));
                    const double distance = glm::length(root - glm::dvec2(x, y) - 0.5);
                    height = std::max(height, (0.5 + 0.5 * random(key + 2)) * (1 - distance / kRadius));
                }
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = 1;
            image.at(x, y, 3) = static_cast<float>(height);
        }
    return image;
}

} // namespace tegument::verify
