#pragma once
// Runs an effect on a scene: creates its targets, uploads its parameters, executes its scripts, reads targets back by name.

#include "host/effect/model.h"
#include "host/gpu/gpu.h"
#include "host/image/image.h"
#include "host/mesh/mesh.h"
#include "host/scene/workspace.h"
#include "host/spirv/compile.h"
#include "host/support/result.h"

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tegument {

/// Textures that belong to a mesh, by the annotation `Generator` of their parameters (docs/running.md). Without functions none are made,
/// and none judged.
struct MeshTextures {
    /// Makes the file where nothing gives one, or finds it made.
    std::function<Result<std::filesystem::path>(const std::string& generator, const Mesh& mesh)> make;
    /// Refuses a file that was made for another mesh.
    std::function<Result<void>(const std::string& generator, const std::filesystem::path& file, const Mesh& mesh)> check;
};

struct RunOptions {
    std::string technique; // empty: the effect's default
    int width = 1024;      // the final target, 1..16384
    int height = 1024;
    int samples = 1; // of a pixel of the caller's targets: 1, 2, 4 or 8; the picture is their mean. The effect's own targets have one
    Compiler compiler = Compiler::Dxc;
    std::map<std::string, std::vector<double>> parameters; // --set; wins over the workspace, which wins over the defaults
    std::map<std::string, std::string> textures;           // --set NAME=file for textures; relative to the current folder
    std::vector<std::string> dump;                         // target names; "all"
    MeshTextures meshTextures;
    /// Albedo, linear, and the scatter mask of skin for which nothing gives a colour map (semantic DIFFUSE), with a warning. None: the
    /// effect's own Fallback.
    std::optional<std::array<float, 4>> plainSkin;
    int warmUpFrames = 0;
    int frames = 1; // pass times are medians over these
};

/// One mesh of a scene of several.
struct RunObject {
    const Mesh* mesh = nullptr;
    Workspace workspace; // workspaceOf(): its own textures and parameters
    Placement placement;
};

struct PassReport {
    std::string name; // "ConvolutionU" ...; a pass run several times: one entry per run, in order
    int object = 0;   // which of the scene's objects it drew
    double milliseconds = 0;
};

struct TargetReport {
    std::string name;
    int width = 0;
    int height = 0;
    std::string format; // D3DFORMAT name as allocated
    std::uint64_t bytes = 0;
};

struct RunResult {
    Image image;                         // the caller's colour target, linear, RGBA 32-bit float
    std::map<std::string, Image> dumped; // by target name, 1 to 4 channels; depth as one channel; of several objects: the last one's
    std::vector<PassReport> passes;
    std::vector<TargetReport> targets; // only what was allocated
    std::uint64_t bytes = 0;           // of all targets
    std::uint64_t deviceBytes = 0;     // of everything on the device: targets, textures, meshes
    std::string technique;
    std::vector<Diagnostic> warnings;
};

/// `mesh` may be null for effects that only draw buffers. Textures that name a producing effect (annotation `Producer =
/// "Stretch.fx/gStretchMap"`) are rendered first and cached on disk. Texture files are found relative to the workspace file, then the
/// effect.
[[nodiscard]] Result<RunResult> runEffect(gpu::Device& device, const Effect& effect, const Mesh* mesh, const Workspace& workspace,
                                          const RunOptions& options);

/// The effect's script once for each object, in order, with the same targets: what it draws into the caller's targets adds up, hidden or
/// not by their common depth; those are cleared once, before the first object. Every other target belongs to one object at a time, so
/// memory does not grow with objects. The light's pyramid is fitted to each object alone: objects throw no shadow on each other.
[[nodiscard]] Result<RunResult> runScene(gpu::Device& device, const Effect& effect, std::span<const RunObject> objects,
                                         const Workspace& workspace, const RunOptions& options);

} // namespace tegument
