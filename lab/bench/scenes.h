#pragma once
// The scenes of the comparison: named ones, written once as ordinary workspace files, and those of the user.

#include "host/mesh/mesh.h"
#include "host/scene/workspace.h"
#include "host/support/result.h"
#include "lab/bench/light_set.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tegument::bench {

/// NAME[@LIGHT][+shadow][+bumps][+checker][+Npx], for example sphere-10@90+checker+4px.
struct SceneName {
    std::string shape;
    std::optional<double> light; // degrees between the direction to the light and that to the camera
    bool shadow = false;         // of a bar before the light
    bool bumps = false;          // a normal map of high frequency
    bool checker = false;        // a colour map in squares
    std::optional<double> pixelsPerMm;
};
[[nodiscard]] const std::vector<std::string>& sceneShapes();
/// TG8072 no such scene, with the nearest name; TG8073 no such variant of it.
[[nodiscard]] Result<SceneName> parseSceneName(const std::string& text);

struct Scene {
    std::string name;
    std::filesystem::path file; // its workspace
    Workspace workspace;
    Mesh mesh; // with the workspace's own textures in place of the mesh file's: what the reference reads
    LightSet lights;
};

struct SceneOptions {
    std::filesystem::path effects; // their folder: has the head's workspace
    std::filesystem::path folder;  // where the named scenes go; empty: cacheFolder()/bench/scenes
    int width = 0;                 // of the picture: the scale of a named scene depends on it
    int height = 0;
    bool needsUvs = true; // of the mesh: skin is lit in texture space
};

/// Whether `text` names a scene or a file, without reading or making any. TG8072, TG8073.
[[nodiscard]] Result<void> checkSceneName(const std::string& text);

/// `text` names a scene or a workspace file of one mesh. TG8074 a workspace of several objects.
[[nodiscard]] Result<Scene> loadScene(const std::string& text, const SceneOptions& options);

} // namespace tegument::bench
