// The built-in body: a lens with a bump, front and back in a chart each.

#include "host/mesh/triangles.h"
#include "lab/verify/painted.h"
#include "lab/verify/scene.h"

#include <cmath>
#include <numbers>

namespace tegument {

namespace {

constexpr int kColumns = 48; // quads a side of each chart
constexpr int kRows = 96;
constexpr double kHalfWidth = 20; // mm
constexpr double kHalfHeight = 40;
constexpr double kHalfThickness = 5;
constexpr double kBumpHeight = 7;
constexpr double kBumpWidth = 4;     // standard deviation, mm
constexpr double kBumpCentre = 6;    // above the middle
constexpr double kChartWidth = 0.44; // of the map; the gap between the charts is 0.06
constexpr double kChartHeight = 0.94;
constexpr double kMargin = 0.03;
constexpr int kTextureSize = 64; // coarser than the pictures: no mip level but the first is read

double lens(double s, double t) {
    return kHalfThickness * (1 - s * s) * (1 - t * t);
}

double bump(double x, double y) {
    const double dy = y - kBumpCentre;
    return kBumpHeight * std::exp(-(x * x + dy * dy) / (2 * kBumpWidth * kBumpWidth));
}

/// s, t in -1..1. At the rim the bump is 3e-5 mm high: front and back meet there.
glm::dvec3 pointAt(double s, double t, bool front) {
    const double x = kHalfWidth * s;
    const double y = kHalfHeight * t;
    return {x, y, front ? lens(s, t) + bump(x, y) : -lens(s, t)};
}

glm::vec3 normalAt(double s, double t, bool front) {
    constexpr double kStep = 1e-5;
    const glm::dvec3 alongS = pointAt(s + kStep, t, front) - pointAt(s - kStep, t, front);
    const glm::dvec3 alongT = pointAt(s, t + kStep, front) - pointAt(s, t - kStep, front);
    return glm::vec3(glm::normalize(glm::cross(alongS, alongT)) * (front ? 1.0 : -1.0));
}

/// The back's chart runs the other way round, so that neither is mirrored.
glm::vec2 uvAt(double s, double t, bool front) {
    const double along = 0.5 * (1 + (front ? s : -s));
    const double left = front ? kMargin : 1 - kMargin - kChartWidth;
    return glm::vec2(left + kChartWidth * along, kMargin + kChartHeight * 0.5 * (1 - t));
}

void addSide(Mesh& mesh, bool front) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int j = 0; j <= kRows; ++j)
        for (int i = 0; i <= kColumns; ++i) {
            const double s = 2.0 * i / kColumns - 1;
            const double t = 2.0 * j / kRows - 1;
            mesh.positions.emplace_back(pointAt(s, t, front));
            mesh.normals.push_back(normalAt(s, t, front));
            mesh.uvs.push_back(uvAt(s, t, front));
        }
    addGrid(mesh.indices, kColumns, kRows, front ? "abdadc" : "adbacd", first);
}

glm::dvec4 colour(double u, double v) {
    const double turn = 2 * std::numbers::pi;
    return {0.75 + 0.15 * std::sin(3 * turn * u), 0.55 + 0.2 * std::sin(4 * turn * v), 0.5 + 0.2 * std::sin(2 * turn * (u + v)), 1};
}

/// Waves of 6 degrees.
glm::dvec4 relief(double u, double v) {
    const double turn = 2 * std::numbers::pi;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.1 * std::sin(6 * turn * u), 0.1 * std::sin(5 * turn * v), 1));
    return {0.5 + 0.5 * normal, 1};
}

} // namespace

Mesh verificationMesh() {
    Mesh mesh;
    mesh.name = "verification body";
    addSide(mesh, true);
    addSide(mesh, false);
    mesh.parts = {{.name = "body", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    // Normals of 8 bits, filtered in 8 bits as software does it, would drown the error of the reflection in that of the look-up.
    mesh.textures = {{.role = "color", .image = verify::painted(kTextureSize, 8, colour)},
                     {.role = "normal", .image = verify::painted(kTextureSize, 16, relief)}};
    computeTangents(mesh);
    computeBounds(mesh);
    return mesh;
}

namespace verify {

Mesh squareMesh(float half) {
    Mesh mesh;
    mesh.name = "plane";
    mesh.positions = {{-half, half, 0}, {-half, -half, 0}, {half, half, 0}, {half, -half, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.tangents.assign(4, {1, 0, 0, 1});
    mesh.uvs = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
    mesh.indices = {0, 1, 2, 2, 1, 3};
    mesh.parts = {{.name = "plane", .firstIndex = 0, .indexCount = 6}};
    computeBounds(mesh);
    return mesh;
}

Scene sceneOf(const VerifyOptions& options) {
    if (options.mesh && options.workspace) return {*options.mesh, *options.workspace};
    Scene scene{verificationMesh(), worldWorkspace()};
    scene.workspace.camera.position = {60, 25, 170};
    scene.workspace.camera.target = {0, 0, 2};
    scene.workspace.camera.horizontalFov = 30;
    scene.workspace.light.position = {-330, 280, 420};
    scene.workspace.light.color = {1.5F, 1.2F, 1.0F};
    return scene;
}

Scene backlit(Scene scene) {
    const glm::vec3 centre = scene.mesh.bounds.centre;
    const PlacedScene placed = placeScene(scene.workspace, scene.mesh.bounds);
    scene.workspace.lightRelative = false;
    scene.workspace.light.position = 2.0F * centre - placed.light.position;
    return scene;
}

} // namespace verify

} // namespace tegument
