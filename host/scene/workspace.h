#pragma once
// The workspace of seed-style tools: global values that effects take by semantic or name. JSON, schema in docs/workspace.md.

#include "host/mesh/mesh.h"
#include "host/scene/placement.h"
#include "host/support/result.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tegument {

/// Right-handed, looks along -z of its own space. Angles in degrees, lengths in mm, or in radii of the mesh (Workspace::cameraRelative).
struct Camera {
    glm::vec3 position{0, 0, 700};
    glm::vec3 target{0};
    glm::vec3 up{0, 1, 0};
    float horizontalFov = 25;
    std::optional<float> nearPlane; // default: fitted to the mesh
    std::optional<float> farPlane;
};

/// One point light, or parallel light. `color` is E/pi at the mesh centre (docs/conventions.md): a white Lambert surface facing it there
/// reflects `color`. What its map covers is fitted to the mesh unless `fov` or `width` says otherwise.
struct Light {
    glm::vec3 position{300, 300, 600}; // of parallel light of no meaning
    glm::vec3 color{1};
    std::optional<glm::vec3> direction; // parallel light goes this way; not 0
    std::optional<float> fov;           // of a point light's square pyramid, degrees
    std::optional<float> width;         // across the map of parallel light, mm, or radii (Workspace::lightRelative)
};

/// A mesh file and how it is to be read.
struct MeshSource {
    std::string meshPath; // relative to the workspace file
    std::optional<double> unitMm;
    std::string attribution;
    bool flipV = false; // the mesh file's v runs against its format's convention
    bool head = true;   // the mesh is a human head: its size is checked
};

/// One of several meshes in a scene.
struct SceneObject : MeshSource {
    Placement placement;
    std::map<std::string, std::string> textures; // these win over the workspace's
    std::map<std::string, std::vector<double>> parameters;
};

struct Workspace : MeshSource {
    std::filesystem::path file;       // empty: built in defaults
    std::vector<SceneObject> objects; // empty: the one mesh above
    /// Millimetres in one unit of the world that the shaders see: WORLD, cameras, lights and planes that semantics bind are in it, and
    /// UNITMM is this number. Everything in this struct, and all that the host computes, is in mm.
    float worldUnitMm = 1;
    /// "mesh" frame: position and target are relative to the bounding sphere's centre in units of its radius; "world": mm.
    bool cameraRelative = true;
    bool lightRelative = true;
    Camera camera{.position = {0, 0, 5}}; // relative: a little more than the whole mesh
    Light light{.position = {-2, 4, 6}};
    glm::vec3 background{0};
    std::map<std::string, std::string> textures;           // parameter name or semantic -> file, relative to the workspace file
    std::map<std::string, std::vector<double>> parameters; // name of a parameter or a switch -> numbers
    // How its picture is drawn, where the caller does not say it.
    std::string technique; // empty: the effect's default one
    std::string setting;   // likewise
    std::optional<std::pair<int, int>> size;
    int samples = 0;                          // a pixel; 0: the usual number
    std::map<std::string, std::string> binds; // of a foreign effect's parameters: AdoptOptions::bind
    std::string pose;                         // files, relative to the workspace file: the mesh, bent
    std::string poseBefore;
};

/// In the frame "world": camera and light are in mm, and no mesh is taken for a head.
[[nodiscard]] Workspace worldWorkspace();

struct WorkspaceOptions {
    bool requireMesh = true; // false: the mesh is given elsewhere, so neither it nor the textures made for it need exist
    std::map<std::string, std::string> makers{}; // by folder of the cache: the command that fills it, for hints
};

/// Unknown and repeated keys, wrong types, values out of range, unset variables and missing files are errors with line and column.
/// "${NAME}" in a path is the environment variable NAME; ${TEGUMENT_CACHE} is always set (cacheFolder()).
[[nodiscard]] Result<Workspace> loadWorkspace(const std::filesystem::path& path, const WorkspaceOptions& options = {});
/// The same from text; `path` names it in messages, and relative paths start from its folder.
[[nodiscard]] Result<Workspace> parseWorkspace(const std::string& text, const std::filesystem::path& path,
                                               const WorkspaceOptions& options = {});

/// How the workspace wants a mesh read. A head is judged by the size that its placement gives it.
[[nodiscard]] MeshOptions meshOptions(const MeshSource& source);
[[nodiscard]] MeshOptions meshOptions(const SceneObject& object);

/// The workspace as one of its objects sees it: with its own mesh, textures and parameters.
[[nodiscard]] Workspace workspaceOf(const Workspace& workspace, const SceneObject& object);

/// Camera and light in world millimetres, planes fitted tightly to the bounds where they were not given.
struct PlacedScene {
    Camera camera; // near and far set
    Light light;
};
[[nodiscard]] PlacedScene placeScene(const Workspace& workspace, const Bounds& bounds);
/// The same scene in the space of an object that stands so: turned and moved back, not scaled.
[[nodiscard]] PlacedScene seenFrom(const PlacedScene& scene, const Placement& placement);
/// The same scene where all lengths are `factor` times as long: in another unit.
[[nodiscard]] PlacedScene inUnit(const PlacedScene& scene, float factor);
[[nodiscard]] Bounds inUnit(const Bounds& bounds, float factor);

} // namespace tegument
