#include "meshprep/assets/scene.h"

#include "host/mesh/read_mesh.h"
#include "host/mesh/triangles.h"
#include "host/run/semantics.h"
#include "host/support/text.h"
#include "meshprep/assets/picture.h"
#include "meshprep/assets/strands.h"
#include "meshprep/prepare/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <tuple>

namespace tegument::assets {

namespace fs = std::filesystem;

namespace {

fs::path beside(const Workspace& workspace, const std::string& path) {
    return workspace.file.has_parent_path() ? workspace.file.parent_path() / path : fs::path(path);
}

Result<Mesh> readMesh(const fs::path& path, const MeshOptions& load, const std::string& attribution) {
    Result<Mesh> mesh = loadMesh(path, load);
    if (mesh && mesh->attribution.empty()) mesh->attribution = attribution;
    return mesh;
}

/// What the workspace says is of its own mesh.
std::string attributionOf(const SceneOptions& options, const Workspace& workspace) {
    std::error_code code;
    const bool another =
        !options.mesh.empty() && !workspace.meshPath.empty() && !fs::equivalent(options.mesh, beside(workspace, workspace.meshPath), code);
    return another ? "" : workspace.attribution;
}

/// A mesh of one's own without a workspace that somebody chose for it.
bool isFramed(const SceneOptions& options) {
    return !options.mesh.empty() && options.workspace.empty();
}

UpAxis upOf(const SceneOptions& options) {
    const MeshFormat* format = meshFormatOf(options.mesh);
    return options.up.value_or(format && format->zIsUp ? UpAxis::Z : UpAxis::Y);
}

/// Turned counter-clockwise seen from above, y up.
glm::vec3 aboutVertical(const glm::vec3& v, double degrees) {
    const auto angle = static_cast<float>(glm::radians(degrees));
    return {std::cos(angle) * v.x + std::sin(angle) * v.z, v.y, std::cos(angle) * v.z - std::sin(angle) * v.x};
}

/// Seen from the right and a little above, with the usual light turned to the mesh's up.
void frame(const SceneOptions& options, const Mesh& skin, Workspace& workspace) {
    Mesh mesh;
    mesh.positions = skin.positions;
    mesh.bounds = skin.bounds;
    if (const auto curves = curvesBeside(options.mesh)) { // which reach beyond the skin
        for (int i = 0; i < 8; ++i)
            mesh.positions.push_back(glm::mix(curves->low, curves->high, glm::vec3(i & 1, i >> 1 & 1, i >> 2 & 1)));
        computeBounds(mesh);
    }
    constexpr glm::vec3 kDirection(0.38F, 0.2F, 0.9F);
    constexpr float kFov = 25;
    const UpAxis up = upOf(options);
    const auto turned = [&](const glm::vec3& v) { return aboutVertical(v, -options.turn); };
    workspace.camera = (options.turns ? frameTurningMesh : frameMesh)(mesh, turned(kDirection), up, kFov, options.aspect);
    workspace.cameraRelative = false;
    if (!workspace.lightRelative) workspace.light = Workspace{}.light; // it was placed for another mesh
    workspace.lightRelative = true;
    workspace.light.position = alongUp(up, turned(workspace.light.position));
    if (workspace.light.direction) workspace.light.direction = alongUp(up, turned(*workspace.light.direction));
    if (up == UpAxis::Z) workspace.parameters.insert({"gFurDown", {0, 0, -1}});
}

/// Charts for a mesh that has none, where it lies and as large as it is.
Result<void> giveCharts(const SceneOptions& options, Scene& scene, Mesh& mesh) {
    prep::PrepOptions prepare;
    prepare.read = {.unitMm = mesh.unitMm, .roots = options.roots};
    prepare.centre = prep::CentreMode::None;
    prepare.unwrap = true;
    prepare.order.reset();
    prepare.levels = 1;
    auto prepared = prep::prepareMesh(options.mesh, prepare);
    if (!prepared) return prepared.error();
    prepared->mesh.warnings = std::move(mesh.warnings);
    prepared->mesh.name = mesh.name;
    mesh = std::move(prepared->mesh);
    for (MeshPart& part : mesh.parts)
        computeClusters(mesh, part);
    scene.guesses.push_back("the mesh has no texture coordinates, and charts are made in each run: tegument prep MESH --unwrap -o NEW.glb "
                            "keeps them");
    return {};
}

/// Seen from the head's left, with the key light on its right, as human.json has them; head and neck fill the picture.
Result<void> portray(const SceneOptions& options, Scene& scene, Mesh& mesh) {
    constexpr glm::vec3 kDirection(0.44F, 0.05F, 0.9F);
    constexpr glm::vec3 kKey(-530, 590, 1000); // mm from the middle of the head
    constexpr float kFov = 25;
    const bool bare = mesh.uvs.empty();
    if (bare)
        if (const auto given = giveCharts(options, scene, mesh); !given) return given.error();
    auto head = layHead(mesh, *options.portrait);
    if (!head) return head.error();
    std::ranges::move(head->guesses, std::back_inserter(scene.guesses));
    Mesh framed;
    framed.positions = framedPoints(mesh, *head);
    computeBounds(framed);
    const auto turned = [&](const glm::vec3& v) { return aboutVertical(v, -options.turn); };
    Workspace& workspace = scene.workspace;
    workspace.camera = (options.turns ? frameTurningMesh : frameMesh)(framed, turned(kDirection), UpAxis::Y, kFov, options.aspect);
    workspace.cameraRelative = false;
    workspace.light = Light{};
    workspace.lightRelative = false;
    const glm::vec3 middle = head->nasion + glm::vec3(0, 0, -95) * head->millimetre;
    workspace.light.position = middle + turned(kKey) * head->millimetre;
    workspace.light.color = glm::vec3(1.7F);
    return {};
}

/// Of radius 1, with texture coordinates and tangents: foreign effects expect objects of about one unit.
Mesh ball() {
    constexpr int kRings = 64;
    constexpr int kSectors = 128;
    Mesh mesh;
    mesh.name = "ball";
    for (int ring = 0; ring <= kRings; ++ring)
        for (int sector = 0; sector <= kSectors; ++sector) {
            const float v = static_cast<float>(ring) / kRings;
            const float u = static_cast<float>(sector) / kSectors;
            const float polar = v * std::numbers::pi_v<float>;
            const float around = u * 2 * std::numbers::pi_v<float>;
            const glm::vec3 normal(std::sin(polar) * std::sin(around), std::cos(polar), std::sin(polar) * std::cos(around));
            mesh.positions.push_back(normal);
            mesh.normals.push_back(normal);
            mesh.tangents.emplace_back(std::cos(around), 0.0F, -std::sin(around), 1.0F);
            mesh.uvs.emplace_back(u, v);
        }
    addGrid(mesh.indices, kSectors, kRings, "acbbcd");
    computeBounds(mesh);
    return mesh;
}

} // namespace

bool isPainted(const fs::path& file) {
    const std::string ending = toLower(file.extension().string());
    return isDisplayed(file) || ending == ".bmp" || ending == ".tga";
}

namespace {

bool anyPainted(const std::map<std::string, std::string>& textures) {
    return std::ranges::any_of(textures, [](const auto& entry) { return isPainted(entry.second); });
}

Result<Mesh> chooseMesh(const SceneOptions& options, const Workspace& workspace) {
    const std::string& path = options.mesh.empty() ? workspace.meshPath : options.mesh;
    if (path.empty() && options.unitSize) return ball();
    if (path.empty()) return usageError(8014, "this technique draws a mesh and none was given", "add --mesh FILE or --workspace FILE");
    MeshOptions load = meshOptions(workspace);
    if (options.unitMm) load.unitMm = options.unitMm;
    if (isFramed(options)) load.expectHead = false;
    if (options.head) load.expectHead = *options.head;
    load.guessUnit = !options.mesh.empty() && !load.expectHead && !options.portrait;
    load.roots = options.roots;
    load.ownCoordinates = options.pictures || anyPainted(workspace.textures);
    return readMesh(options.mesh.empty() ? beside(workspace, path) : fs::path(path), load, attributionOf(options, workspace));
}

Result<void> readPoses(const SceneOptions& options, const Mesh& rest, Scene& scene) {
    for (const auto& [file, pose] : {std::pair(&options.pose, &scene.pose), std::pair(&options.poseBefore, &scene.poseBefore)}) {
        if (file->empty()) continue;
        auto read = readPose(*file, rest, meshOptions(scene.workspace));
        if (!read) return read.error();
        *pose = *std::move(read);
    }
    return {};
}

/// The moment that is asked for. Bounds, and what is framed, hold the whole animation, so that the camera stands still. `swept`: where
/// vertices are in its course.
Result<void> move(const SceneOptions& options, Mesh& mesh, Scene& scene, Mesh& swept) {
    if (!options.motion.any()) return {};
    constexpr int kMoments = 16;
    constexpr std::size_t kMostPoints = 1'000'000;
    Mesh posed = mesh;
    if (const auto moved = poseMesh(posed, options.motion); !moved) return moved.error();
    const auto animation = chosenAnimation(mesh, options.motion);
    scene.motionSeconds = *animation ? (*animation)->seconds : 0;
    swept.positions = posed.positions;
    const std::size_t step = 1 + kMoments * mesh.positions.size() / kMostPoints;
    for (int i = 0; *animation && i <= kMoments; ++i) {
        Mesh then = mesh;
        PoseChoice moment = options.motion;
        moment.time = (*animation)->seconds * i / kMoments;
        if (const auto moved = poseMesh(then, moment); !moved) return moved.error();
        for (std::size_t k = 0; k < then.positions.size(); k += step)
            swept.positions.push_back(then.positions[k]);
    }
    computeBounds(swept);
    posed.bounds = swept.bounds;
    if (options.bends)
        scene.pose = std::move(posed);
    else
        mesh = std::move(posed);
    return {};
}

/// Foreign effects expect about that, round the origin; many know no WORLD.
void toUnitSize(Mesh& mesh) {
    if (!(mesh.bounds.radius > 0)) return;
    for (glm::vec3& position : mesh.positions)
        position = (position - mesh.bounds.centre) / mesh.bounds.radius;
    computeBounds(mesh);
}

/// The workspace as it would have to be to say the same without the command line.
void adoptMesh(const SceneOptions& options, const Mesh& mesh, Workspace& workspace) {
    const auto whole = [](const std::string& path) {
        std::error_code none;
        return path.empty() ? path : fs::absolute(path, none).string();
    };
    if (!options.mesh.empty()) workspace.meshPath = whole(options.mesh);
    workspace.pose = whole(options.pose);
    workspace.poseBefore = whole(options.poseBefore);
    if (!options.mesh.empty() || options.unitMm) workspace.unitMm = mesh.unitMm;
    if (isFramed(options)) workspace.head = false;
    if (options.head) workspace.head = *options.head;
}

/// Objects whose meshes are read alike share one.
Result<void> loadObjects(Scene& scene, const Roots& roots) {
    std::map<std::tuple<std::string, std::optional<double>, bool, float, bool, std::string>, const Mesh*> known;
    for (const SceneObject& object : scene.workspace.objects) {
        const fs::path path = beside(scene.workspace, object.meshPath);
        const float judged = object.head ? object.placement.scale.y : 0; // a head's size is judged with it
        const bool painted = anyPainted(object.textures) || anyPainted(scene.workspace.textures);
        const Mesh*& mesh = known[{fs::weakly_canonical(path).string(), object.unitMm, object.flipV, judged, painted, object.attribution}];
        if (!mesh) {
            MeshOptions load = meshOptions(object);
            load.roots = roots;
            load.ownCoordinates = painted;
            auto read = readMesh(path, load, object.attribution);
            if (!read) return read.error();
            mesh = &scene.meshes.emplace_back(std::move(*read));
        }
        scene.objects.push_back({.mesh = mesh, .workspace = workspaceOf(scene.workspace, object), .placement = object.placement});
    }
    return {};
}

/// A scene that was not framed, as `frame` does with those that are.
void turn(double degrees, Scene& scene) {
    if (degrees == 0) return;
    const SessionScene seen = sessionScene(scene);
    const glm::dvec3 pivot(run::boundsOf(seen).centre);
    scene.workspace = turnedScene(run::inWorld(scene.workspace, seen), pivot, glm::radians(degrees));
}

} // namespace

Result<Workspace> chooseWorkspace(const SceneOptions& options, bool requireMesh) {
    const WorkspaceOptions load = workspaceOptions(requireMesh && options.mesh.empty());
    if (!options.workspace.empty()) return loadWorkspace(options.workspace, load);
    const fs::path usual = fs::path(options.effect).parent_path() / "workspaces" / options.usual;
    std::error_code code;
    if (!fs::is_regular_file(usual, code)) return Workspace{};
    Result<Workspace> workspace = loadWorkspace(usual, load);
    if (!workspace || options.mesh.empty()) return workspace;
    workspace->attribution.clear(); // these spoke of its mesh
    workspace->textures.clear();
    workspace->unitMm.reset();
    workspace->flipV = false;
    return workspace;
}

WorkspaceOptions workspaceOptions(bool requireMesh) {
    return {.requireMesh = requireMesh, .makers = {{"human", "tegument prep human"}, {"fur", "tegument prep bunny"}}};
}

Result<Scene> loadScene(const SceneOptions& options, bool needsMesh) {
    auto workspace = chooseWorkspace(options, needsMesh);
    if (!workspace) return workspace.error();
    Scene scene{.workspace = std::move(*workspace), .isOwn = !options.mesh.empty()};
    if (!needsMesh) return scene;
    if (!scene.workspace.objects.empty()) {
        if (!options.mesh.empty() || options.unitMm || !options.pose.empty() || options.motion.any())
            return usageError(8017,
                              fmt::format("{} has {} objects: which of them is meant?", options.workspace, scene.workspace.objects.size()),
                              "leave --mesh, --unit-mm and --time out, or give a workspace of one mesh");
        if (const auto loaded = loadObjects(scene, options.roots); !loaded) return loaded.error();
        turn(options.turn, scene);
        return scene;
    }
    auto mesh = chooseMesh(options, scene.workspace);
    if (!mesh) return mesh.error();
    Mesh swept;
    if (const auto moved = move(options, *mesh, scene, swept); !moved) return moved.error();
    if (options.unitSize && options.workspace.empty()) toUnitSize(*mesh);
    if (const auto read = readPoses(options, *mesh, scene); !read) return read.error();
    if (options.portrait) {
        if (const auto laid = portray(options, scene, *mesh); !laid) return laid.error();
    } else if (isFramed(options)) {
        frame(options, !swept.positions.empty() ? swept : scene.pose ? *scene.pose : *mesh, scene.workspace);
    }
    if (options.unitSize && options.workspace.empty()) { // shells and waves leave the mesh's own bounds
        scene.workspace.camera.nearPlane = 0.1F;
        scene.workspace.camera.farPlane = 100;
    }
    adoptMesh(options, *mesh, scene.workspace);
    scene.meshes.push_back(std::move(*mesh));
    if (!isFramed(options)) turn(options.turn, scene);
    return scene;
}

SessionScene sessionScene(const Scene& scene) {
    if (!scene.objects.empty()) return {.mesh = nullptr, .objects = scene.objects};
    return {.mesh = scene.meshes.empty() ? nullptr : &scene.meshes.front()};
}

Result<RunResult> runScene(gpu::Device& device, const Effect& effect, const Scene& scene, const RunOptions& options) {
    if (!scene.objects.empty()) return runScene(device, effect, scene.objects, scene.workspace, options);
    return runEffect(device, effect, scene.meshes.empty() ? nullptr : &scene.meshes.front(), scene.workspace, options);
}

} // namespace tegument::assets
