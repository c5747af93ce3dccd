#pragma once
// The scene of a run, read from disk: workspace and meshes.

#include "host/mesh/motion.h"
#include "host/run/run.h"
#include "host/scene/framing.h"
#include "meshprep/portrait/portrait.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace tegument::assets {

struct SceneOptions {
    std::string effect;     // the effect file: its folder has the default workspace
    std::string workspace;  // empty: the usual one of the effects' own folder, else built-in defaults
    std::string usual;      // its name: human.json where the effect's annotation Workspace names no other
    std::string mesh;       // in place of the workspace's
    std::string pose;       // the same mesh, bent; empty: at rest
    std::string poseBefore; // and in the frame before
    PoseChoice motion{};    // the moment of its own animation
    bool bends = false;     // the effect takes the mesh at rest and its pose apart, as those with strands do
    std::optional<double> unitMm;
    std::optional<bool> head; // the mesh is a human head, or is none; none: as the workspace says, and a mesh of one's own is none
    std::optional<UpAxis> up; // of a mesh of one's own; none: z of STL files, else y
    double turn = 0;       // degrees that the scene is turned by, counter-clockwise seen from above; camera and light stay for the viewer
    double aspect = 1;     // of the picture
    bool unitSize = false; // the effect expects a mesh of radius 1: without one it is shown on a ball
    bool turns = false;    // a mesh of one's own is framed so that it can turn
    std::optional<PortraitHints> portrait{}; // the mesh is a head, to be laid and framed as in a portrait
    bool pictures = false; // a picture is given for the mesh: its coordinates stay as they are (MeshOptions::ownCoordinates)
    Roots roots{};         // where else files may lie that meshes name
};

/// `workspace.objects` empty: one mesh, or none.
struct Scene {
    Workspace workspace;
    std::deque<Mesh> meshes; // each file once, however many objects have it
    std::vector<RunObject> objects;
    std::optional<Mesh> pose{}; // of the only mesh: its skin, bent
    std::optional<Mesh> poseBefore{};
    double motionSeconds = 0;           // of the animation that is chosen
    bool isOwn = false;                 // the mesh is the user's, not the workspace's
    std::vector<std::string> guesses{}; // of a portrait: a line each, with the option that says otherwise
};

/// Whether the name is that of a painted or photographed picture, which lies by the mesh's own texture coordinates; baked maps (DDS, EXR)
/// lie by those that the mesh is drawn with.
[[nodiscard]] bool isPainted(const std::filesystem::path& file);

/// A workspace whose mesh is one that the program makes, and is not there, names the command.
[[nodiscard]] WorkspaceOptions workspaceOptions(bool requireMesh = true);

/// The one that is named, else the usual one, else built-in defaults. With a mesh of one's own only light, background and parameters of a
/// usual one stay, and what it says of how the picture is drawn.
[[nodiscard]] Result<Workspace> chooseWorkspace(const SceneOptions& options, bool requireMesh);

/// Without `needsMesh` none is read, nor need it exist. TG8014 none was given, TG8017 --mesh or --unit-mm for a scene of several objects.
[[nodiscard]] Result<Scene> loadScene(const SceneOptions& options, bool needsMesh);

/// Points into `scene`.
[[nodiscard]] SessionScene sessionScene(const Scene& scene);

[[nodiscard]] Result<RunResult> runScene(gpu::Device& device, const Effect& effect, const Scene& scene, const RunOptions& options);

} // namespace tegument::assets
