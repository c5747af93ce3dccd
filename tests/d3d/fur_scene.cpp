#include "tests/d3d/fur_scene.h"

#include "host/image/dds.h"
#include "meshprep/fur/cube_texture.h"
#include "meshprep/fur/fur_map.h"
#include "meshprep/fur/ribbons/ribbons.h"

#include <cmath>
#include <numbers>

namespace tegument::test {

namespace {

constexpr int kSphereMapSize = 256;
constexpr int kCubeMapSize = 104; // about as many texels

std::filesystem::path mapFile(const char* name) {
    return drawings() / (std::string(name) + ".dds");
}

} // namespace

bool drawsFur(const Case& drawn) {
    return drawn.effect.stem().string().starts_with("Fur");
}

Mesh furMesh() {
    constexpr int kAround = 48;
    constexpr int kAcross = 24;
    constexpr float kRadius = 60; // mm
    constexpr float kThickness = 25;
    constexpr float kTilt = 0.9F;
    Mesh mesh;
    mesh.name = "torus";
    for (int i = 0; i < kAround; ++i)
        for (int j = 0; j < kAcross; ++j) {
            const float a = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kAround;
            const float b = 2 * std::numbers::pi_v<float> * static_cast<float>(j) / kAcross;
            const float out = kRadius + kThickness * std::cos(b);
            const glm::vec3 flat(out * std::cos(a), kThickness * std::sin(b), -out * std::sin(a));
            mesh.positions.emplace_back(flat.x, std::cos(kTilt) * flat.y - std::sin(kTilt) * flat.z,
                                        std::sin(kTilt) * flat.y + std::cos(kTilt) * flat.z);
            mesh.uvs.emplace_back(static_cast<float>(i) / kAround, static_cast<float>(j) / kAcross);
        }
    const auto at = [](int i, int j) { return static_cast<std::uint32_t>(i % kAround * kAcross + j % kAcross); };
    for (int i = 0; i < kAround; ++i)
        for (int j = 0; j < kAcross; ++j)
            mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i + 1, j), at(i, j + 1), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    mesh.parts = {{.name = "torus", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeBounds(mesh);
    computeNormals(mesh);
    computeTangents(mesh);
    return mesh;
}

Result<void> writeFurMaps() {
    const FurOptions cones{.density = 0.02, .spacing = 4, .radius = 5, .shortest = 0.5, .taper = true};
    const auto onSphere = strandsOnSphere(sphereMapTexels(kSphereMapSize), cones);
    const auto onCube = strandsOnSphere(cubeMapTexels(kCubeMapSize), cones);
    if (!onSphere) return onSphere.error();
    if (!onCube) return onCube.error();
    const Image sphere = drawSphereMap(*onSphere, kSphereMapSize, cones);
    if (auto written = writeDds(mapFile("fur_sphere"), makeDds(sphere, DdsFormat::Rgba8, true)); !written) return written;
    // llvmpipe filters eight bits of a cube map with weights of eight bits where it filters each face by itself, as Direct3D 9 does, and
    // with floats where it filters across edges: a map of floats is filtered alike.
    return writeDds(mapFile("fur_cube"), cubeTexture(drawCubeMap(*onCube, kCubeMapSize, cones), DdsFormat::Rgba32F));
}

Result<void> writeFurRoots(Mesh& mesh) {
    constexpr std::size_t kRoots = 4000;
    const auto roots = growRibbons(mesh, {.count = kRoots, .shortest = 0.5, .lean = 0.3, .comb = {1, 0, 0}});
    if (!roots) return roots.error();
    return writeDds(mapFile("fur_roots"), makeDds(*roots, DdsFormat::Rgba32F, false));
}

Workspace furWorkspace() {
    Workspace workspace;
    workspace.head = false;
    workspace.camera.position = {0.3F, 0.4F, 4.8F};
    workspace.light.position = {-3.2F, 3.6F, 6};
    workspace.light.color = glm::vec3(1.2F);
    workspace.background = glm::vec3(2, 4, 6) / 255.0F;
    workspace.textures = {{"gFurCubeMap", mapFile("fur_cube").string()},
                          {"gFurSphereMap", mapFile("fur_sphere").string()},
                          {"gFurRootsMap", mapFile("fur_roots").string()}};
    workspace.parameters = {{"gFurLayers", {16}},  {"gFurTaper", {1}},      {"gFurFill", {0.1, 0.2, 0.3}},
                            {"gFurCurl", {0.01}},  {"gFurSpacing", {0.03}}, {"gFurDeviation", {0.19}}, // outlines are seen as from afar
                            {"gFurGrain", {0.03}}, {"gFurShadow", {1}}};
    // The clients list no ribbons, so they draw every row. Of thin strands few: rounding decides at pixels between core and fringe.
    for (const char* name : {"gRibbonSegment", "gCoatSegment", "gRibbonFewest"})
        workspace.parameters[name] = {0};
    return workspace;
}

} // namespace tegument::test
