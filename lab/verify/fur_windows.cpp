#include "lab/verify/fur_windows.h"

#include "generated/setting_names.h"
#include "host/mesh/triangles.h"
#include "lab/verify/fur_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace tegument::verify {

namespace {

constexpr double kRootsReach = 2.5; // of a root: strands stray, a step and a pixel are wide
constexpr double kAway = 40;        // of the eye, radii of the mesh

/// How strands bend.
struct Bends {
    double scatter = 0; // spacings, as the two below
    double curls = 0;
    double tufts = 0;
    double lean = 0; // share of the coat
    double comb = 0; // lean of roots: likewise
};

/// What is looked at: the skin where a line from `from` towards `to` (radii of the mesh) meets it.
struct WindowView {
    const char* name;
    Mesh (*mesh)();
    glm::dvec3 from{0};
    glm::dvec3 to{0};
    double tilt = 0; // of the skin, degrees
    Bends bends;
    double fewest = 4;                    // of 32 layers; 32: all are drawn, else what the view asks for
    double coat = 5;                      // spacings
    double spacing = 0.02;                // radii
    double pixel = 0.125;                 // spacings
    int pieces = 12;                      // of an exact strand
    std::array<WindowLimits, 2> limits{}; // of Cellular and of Roots
};

Mesh plane() {
    constexpr int kQuads = 40;
    constexpr float kHalf = 100; // mm
    Mesh mesh;
    mesh.name = "plane";
    for (int j = 0; j <= kQuads; ++j)
        for (int i = 0; i <= kQuads; ++i) {
            const glm::vec2 uv(static_cast<float>(i) / kQuads, static_cast<float>(j) / kQuads);
            mesh.positions.emplace_back(kHalf * (2 * uv.x - 1), 0, kHalf * (2 * uv.y - 1));
            mesh.normals.emplace_back(0, 1, 0);
            mesh.uvs.push_back(uv);
        }
    addGrid(mesh.indices, kQuads, kQuads, "acdadb");
    mesh.parts = {{.name = mesh.name, .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeTangents(mesh);
    computeBounds(mesh);
    return mesh;
}

/// A ball as a scanner has it: bumps, noise in every vertex, triangles of all shapes, normals from the triangles.
Mesh roughBall() {
    Mesh mesh = verificationBall(144, 72);
    mesh.name = "rough ball";
    std::mt19937 random(7);
    const auto noise = [&] { return static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 0.5; };
    const double radius = static_cast<double>(mesh.bounds.radius);
    constexpr double kBumps = 0.02; // of the radius, as the two below
    constexpr double kNoise = 0.0006;
    constexpr double kShift = 0.012;
    std::vector<glm::dvec3> shifts;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        shifts.emplace_back(noise(), noise(), noise());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        // Vertices at one place stay at one place: those of the seam and of the poles keep theirs.
        const bool shared = mesh.uvs[i].x <= 0 || mesh.uvs[i].x >= 1 || mesh.uvs[i].y <= 0 || mesh.uvs[i].y >= 1;
        glm::dvec3 d = glm::normalize(glm::dvec3(mesh.positions[i]) + (shared ? 0 : kShift * radius) * shifts[i]);
        const double bump = std::sin(7 * d.x + 1) * std::sin(9 * d.y) * std::sin(8 * d.z + 2) + 0.4 * std::sin(21 * d.y + 17 * d.x);
        const double own = shared ? 0 : kNoise * shifts[i].x;
        mesh.positions[i] = glm::vec3(radius * (1 + kBumps * bump + own) * d);
    }
    mesh.normals.clear();
    mesh.tangents.clear();
    computeNormals(mesh);
    computeTangents(mesh);
    computeBounds(mesh);
    return mesh;
}

Mesh fineBall() {
    return verificationBall(384, 192);
}

Mesh fineTorus() {
    return verificationTorus(384, 160);
}

constexpr Bends kAll{.scatter = 0.4, .curls = 0.15, .tufts = 1.5, .lean = 0.25, .comb = 0.3};
constexpr Bends kNoTufts{.scatter = 0.4, .curls = 0.15, .lean = 0.25, .comb = 0.3};

// Limits: a tenth to a seventh more than lavapipe draws with 64 or 128 pixels a side. All of it is the effect's own: one sample to a pixel
// and edges of strands as soft as one, 0.016 to 0.037 of brightness (docs/design/fur-layers.md), which is 0.06 to 0.1 of the mean; and
const char* const kWindowOnPlane =
    "one sample to a pixel; strands bend evenly from layer to layer, and their sections where tufts draw together";
const char* const kOnBall = "one sample to a pixel; rays that cross several spacings are bent to the second order only";
const char* const kOnTorus = "one sample to a pixel; strands are straight between the four layers that the view asks for";
const char* const kWindowOnRough = "one sample to a pixel; normals that differ from vertex to vertex make layers rougher than the skin";
const char* const kWindowFromAfar =
    "one sample to a pixel at outlines; strands counted as independent, not as they stand (docs/design/modules/FurRoots.md)";

const char* const kOnScan =
    "one sample to a pixel; normals of a scan differ from vertex to vertex; roots lean as the coat around them does, "
    "smoothed over four cells";
constexpr double kRim = 0.15; // of the ball's disc, which the light sees edge-on

/// One after the other: everything that bends strands; a bent skin alone, seen so aslant that rays take several steps; both, by as few
/// layers as the view asks for; all of it on a mesh as scanners give them; coverage to expect.
const std::array kViews = {
    WindowView{.name = "plane",
               .mesh = plane,
               .from = {0.1, 3, 0.2},
               .to = {0.1, 0, 0.2},
               .tilt = 45,
               .bends = kAll,
               .fewest = 32,
               .limits = {{{0.065, 0.012, kWindowOnPlane}, {0.1, 0.012, kWindowOnPlane}}}},
    WindowView{
        .name = "ball", .mesh = fineBall, .from = {1, 1, 2}, .tilt = 70, .limits = {{{0.165, 0.015, kOnBall}, {0.14, 0.03, kOnBall}}}},
    WindowView{.name = "torus",
               .mesh = fineTorus,
               .from = {2, 2, 2},
               .to = {0.6, 0, 0.4},
               .tilt = 35,
               .bends = kNoTufts,
               .coat = 3,
               .limits = {{{0.15, 0.015, kOnTorus}, {0.13, 0.03, kOnTorus}}}},
    WindowView{.name = "rough ball",
               .mesh = roughBall,
               .from = {-1, 1, 2},
               .tilt = 30,
               .bends = kAll,
               .fewest = 32,
               .coat = 3,
               .limits = {{{0.085, 0.01, kWindowOnRough}, {0.08, 0.015, kWindowOnRough}}}},
    WindowView{.name = "ball from afar",
               .mesh = fineBall,
               .from = {0, 0.3, 2},
               .bends = kAll,
               .coat = 4,
               .spacing = 0.02,
               .pixel = 1.5,
               .pieces = 5,
               .limits = {{{0.22, 0.06, kWindowFromAfar, kRim}, {0.2, 0.06, kWindowFromAfar, kRim}}}},
};

void place(StrandsScene& scene, const WindowView& view, int size) {
    const reference::RayScene rays(scene.scene.mesh);
    const auto& bounds = scene.scene.mesh.bounds;
    const glm::dvec3 centre(bounds.centre);
    const auto radius = static_cast<double>(bounds.radius);
    const glm::dvec3 from = centre + radius * view.from;
    const auto hit = rays.nearest(from, glm::normalize(view.to - view.from));
    const glm::dvec3 skin = hit ? reference::interpolate(scene.scene.mesh, hit->place).position : centre;
    const glm::dvec3 normal = hit ? glm::normalize(reference::interpolate(scene.scene.mesh, hit->place).normal) : glm::dvec3(0, 0, 1);
    const glm::dvec3 across = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.8, 0.52)));
    const double tilt = glm::radians(view.tilt);
    const glm::dvec3 target = skin + 0.5 * scene.fur.thickness * normal;
    Workspace& workspace = scene.scene.workspace;
    workspace.head = false;
    workspace.cameraRelative = false;
    workspace.lightRelative = false;
    workspace.camera.target = glm::vec3(target);
    workspace.camera.position = glm::vec3(target + kAway * radius * (std::cos(tilt) * normal + std::sin(tilt) * across));
    workspace.camera.up = glm::vec3(glm::cross(normal, across));
    workspace.camera.horizontalFov =
        static_cast<float>(glm::degrees(2 * std::atan(view.pixel * scene.fur.spacing * size / 2 / (kAway * radius))));
    workspace.camera.nearPlane = static_cast<float>((kAway - 3) * radius);
    workspace.camera.farPlane = static_cast<float>((kAway + 3) * radius);
    workspace.light.position = glm::vec3(centre + 8 * radius * glm::normalize(normal + 0.35 * glm::cross(normal, across) - 0.25 * across));
    workspace.light.color = {1.5F, 1.2F, 1.0F};
    workspace.background = {0.02F, 0.03F, 0.04F};
}

/// Whether a picture may show what grows at this place.
struct InPicture {
    const reference::Pinhole& camera;
    double margin; // mm

    bool operator()(const glm::dvec3& point) const {
        const glm::dvec2 at = camera.project(point);
        const double wide = margin / camera.footprint(glm::dot(point - camera.eye, camera.forward)) / camera.width;
        return std::min({at.x, at.y, 1 - at.x, 1 - at.y}) > -wide;
    }
};

} // namespace

std::vector<std::string> windowNames(const VerifyOptions& options) {
    if (options.mesh) return {"mesh"};
    std::vector<std::string> names;
    for (const WindowView& view : kViews)
        names.emplace_back(view.name);
    return names;
}

namespace {

/// As the name says, but for what is changed. A mesh of the options is looked at as the rough ball is.
WindowView viewOf(const std::string& name, const WindowChange& change) {
    const auto found = std::ranges::find_if(kViews, [&](const WindowView& view) { return name == view.name; });
    WindowView view = found == kViews.end() ? kViews[3] : *found;
    if (found == kViews.end()) view.limits = {{{0.24, 0.03, kOnScan, 0.13}, {0.25, 0.03, kOnScan, 0.13}}};
    view.bends.scatter = change.scatter.value_or(view.bends.scatter);
    view.bends.curls = change.curls.value_or(view.bends.curls);
    view.bends.tufts = change.tufts.value_or(view.bends.tufts);
    view.bends.lean = change.lean.value_or(view.bends.lean);
    view.bends.comb = change.comb.value_or(view.bends.comb);
    view.pixel = change.pixel.value_or(view.pixel);
    view.tilt = change.tilt.value_or(view.tilt);
    view.coat = change.coat.value_or(view.coat);
    return view;
}

} // namespace

Result<FurWindow> makeWindow(const VerifyOptions& options, const std::string& technique, const std::string& name,
                             const WindowChange& change) {
    const WindowView view = viewOf(name, change);
    FurWindow window{.strands = {.name = name, .technique = technique}, .lattice = technique == "Cellular"};
    window.pieces = view.pieces;
    window.size = std::max(32, options.pictureSize / 2);
    window.limits = view.limits[window.lattice ? 0 : 1];
    StrandsScene& scene = window.strands;
    scene.scene.mesh = options.mesh ? *options.mesh : view.mesh();
    const auto radius = static_cast<double>(scene.scene.mesh.bounds.radius);
    scene.coat = {.layers = change.layers.value_or(32),
                  .length = view.coat * view.spacing,
                  .lean = view.bends.lean,
                  .kajiyaKay = options.setting == kSettingSeed ? 0.0 : 1.0,
                  .fill = {0.05, 0.1, 0.15}};
    scene.fur = {.spacing = view.spacing * radius,
                 .thickness = scene.coat.length * radius,
                 .layers = scene.coat.layers,
                 .fewest = change.fewest.value_or(view.fewest),
                 .scatter = view.bends.scatter,
                 .curls = view.bends.curls,
                 .tufts = view.bends.tufts,
                 .lean = view.bends.lean * glm::dvec3(0, -1, 0)};
    if (!window.lattice) {
        const RootOptions roots{.density = 1 / (scene.fur.spacing * scene.fur.spacing),
                                .reach = kRootsReach,
                                .lean = view.bends.comb,
                                .comb = {0.6, -0.5, 0.6},
                                .furLength = scene.coat.length};
        if (const auto grown = growRoots(scene, roots); !grown) return grown.error();
    }
    place(scene, view, window.size);
    const reference::FurSwept& fur = scene.fur;
    window.shape = {.spacing = fur.spacing,
                    .thickness = fur.thickness,
                    .scatter = fur.scatter,
                    .curls = fur.curls,
                    .turns = fur.turns,
                    .tufts = fur.tufts,
                    .tuftSize = fur.tuftSize,
                    .origin = window.lattice ? glm::dvec3(scene.scene.mesh.bounds.centre) : glm::dvec3(0),
                    .lean = fur.lean};
    return window;
}

std::vector<reference::FurGrown> strandsOf(const FurWindow& window, const reference::RayScene& skin, const reference::Pinhole& camera) {
    const StrandsScene& scene = window.strands;
    const reference::FurSwept& fur = scene.fur;
    const InPicture inPicture{camera, 2 * fur.thickness + (2 + fur.scatter + fur.curls + 2 * fur.tufts) * fur.spacing};
    if (window.lattice)
        return reference::latticeOn(skin,
                                    {.centre = glm::dvec3(scene.scene.mesh.bounds.centre),
                                     .spacing = fur.spacing,
                                     .radius = fur.radius,
                                     .shortest = fur.shortest,
                                     .variation = fur.variation},
                                    inPicture);
    std::vector<reference::FurGrown> strands;
    for (const Root& root : scene.set.roots) {
        if (!inPicture(glm::dvec3(root.position))) continue;
        const glm::dvec3 random = randomOf(root);
        strands.push_back({.root = glm::dvec3(root.position),
                           .lean = glm::dvec3(root.lean),
                           .length = std::min(static_cast<double>(root.share), static_cast<double>(root.limit) / fur.thickness),
                           .radius = fur.radius * fur.spacing * static_cast<double>(root.radius) / scene.set.radius,
                           .stray = static_cast<double>(root.curl),
                           .side = random - 0.5,
                           .tint = 1 + fur.variation * (random.z - 0.5)});
    }
    return strands;
}

} // namespace tegument::verify
