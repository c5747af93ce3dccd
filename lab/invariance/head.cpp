// The generated head: a star-shaped body over the faces of a cube, each a chart of its own.

#include "host/mesh/triangles.h"
#include "lab/invariance/invariance.h"
#include "lab/verify/painted.h"

#include <array>
#include <cmath>
#include <numbers>

namespace tegument {

namespace {

constexpr int kQuads = 20;                   // along a side of each chart
constexpr glm::dvec3 kHalfAxes{75, 100, 92}; // mm
constexpr double kMargin = 0.02;             // of the map, around each chart
// Coarser than the pictures, and smooth: mip levels hardly matter, which devices choose by blocks of 2 x 2 pixels.
constexpr int kTextureSize = 32;

/// A swelling (or a hollow) around a direction from the middle, `width` radians wide.
struct Bump {
    glm::dvec3 towards;
    double width;
    double height; // mm
};

const std::array kBumps = {
    Bump{{0, -0.05, 1}, 0.13, 24},      // nose
    Bump{{0, -0.75, 0.8}, 0.28, 10},    // chin
    Bump{{0, 0.33, 1}, 0.3, 6},         // brows
    Bump{{0.36, 0.17, 0.9}, 0.15, -9},  // sockets of the eyes, one deeper than the other
    Bump{{-0.36, 0.17, 0.9}, 0.15, -6}, //
    Bump{{1, 0, -0.05}, 0.12, 20},      // ears: the left one sticks out
    Bump{{-1, 0, -0.05}, 0.2, 5},       //
    Bump{{0.3, -0.45, 0.85}, 0.1, 3},   // a wart on one cheek
};

double distanceTo(const glm::dvec3& direction) {
    double distance = 1 / glm::length(direction / kHalfAxes);
    for (const Bump& bump : kBumps) {
        const double away = 2 * (1 - glm::dot(direction, glm::normalize(bump.towards))); // square of the chord
        distance += bump.height * std::exp(-away / (2 * bump.width * bump.width));
    }
    return distance;
}

struct Face {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 outwards; // right x up
    bool mirroredChart = false;
};

constexpr std::array kFaces = {
    Face{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},  Face{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, Face{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}, true},
    Face{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}, Face{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},  Face{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
};

/// s, t in -1..1, evenly in angle.
glm::dvec3 pointAt(const Face& face, double s, double t) {
    constexpr double kEighth = std::numbers::pi / 4;
    const glm::dvec3 direction = glm::normalize(face.outwards + std::tan(kEighth * s) * face.right + std::tan(kEighth * t) * face.up);
    return distanceTo(direction) * direction;
}

glm::vec3 normalAt(const Face& face, double s, double t) {
    constexpr double kStep = 1e-5;
    const glm::dvec3 alongS = pointAt(face, s + kStep, t) - pointAt(face, s - kStep, t);
    const glm::dvec3 alongT = pointAt(face, s, t + kStep) - pointAt(face, s, t - kStep);
    return glm::vec3(glm::normalize(glm::cross(alongS, alongT)));
}

/// Three charts in each of two rows.
glm::vec2 uvAt(std::size_t chart, bool mirrored, double s, double t) {
    const glm::dvec2 size(1.0 / 3, 1.0 / 2);
    const glm::dvec2 corner = size * glm::dvec2(chart % 3, chart / 3) + kMargin;
    const glm::dvec2 within(0.5 + (mirrored ? -0.5 : 0.5) * s, 0.5 - 0.5 * t);
    return glm::vec2(corner + within * (size - 2 * kMargin));
}

void addFace(Mesh& mesh, std::size_t chart) {
    const Face& face = kFaces[chart];
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int j = 0; j <= kQuads; ++j)
        for (int i = 0; i <= kQuads; ++i) {
            const double s = 2.0 * i / kQuads - 1;
            const double t = 2.0 * j / kQuads - 1;
            mesh.positions.emplace_back(pointAt(face, s, t));
            mesh.normals.push_back(normalAt(face, s, t));
            mesh.uvs.push_back(uvAt(chart, face.mirroredChart, s, t));
        }
    addGrid(mesh.indices, kQuads, kQuads, "abdadc", first);
}

constexpr double kTurn = 2 * std::numbers::pi;

glm::dvec4 colour(double u, double v) {
    return {0.75 + 0.15 * std::sin(2 * kTurn * u), 0.55 + 0.15 * std::sin(3 * kTurn * v), 0.5 + 0.15 * std::sin(2 * kTurn * (u + v)), 1};
}

/// Waves of 8 and 6 degrees.
glm::dvec4 relief(double u, double v) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.14 * std::sin(7 * kTurn * u), 0.1 * std::sin(5 * kTurn * v), 1));
    return {0.5 + 0.5 * normal, 1};
}

} // namespace

Mesh invarianceMesh() {
    Mesh mesh;
    mesh.name = "generated head";
    for (std::size_t chart = 0; chart < kFaces.size(); ++chart)
        addFace(mesh, chart);
    mesh.parts = {{.name = mesh.name, .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    mesh.textures = {{.role = "color", .image = verify::painted(kTextureSize, 8, colour)},
                     {.role = "normal", .image = verify::painted(kTextureSize, 16, relief)}};
    computeTangents(mesh);
    computeBounds(mesh);
    return mesh;
}

Workspace invarianceWorkspace() {
    Workspace workspace = worldWorkspace();
    workspace.camera.position = {230, 70, 480};
    workspace.camera.target = {4, 0, 5};
    workspace.camera.horizontalFov = 25;
    workspace.light.position = {-330, 280, 420};
    workspace.light.color = {1.5F, 1.2F, 1.0F};
    workspace.background = {0.02F, 0.03F, 0.04F};
    return workspace;
}

} // namespace tegument
