#pragma once
// What a run is asked for, and of what scene. Needs no GPU.

#include "host/mesh/mesh.h"
#include "host/scene/workspace.h"
#include "host/spirv/compile.h"

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tegument {

struct DrawList;
struct PassRequest;

/// What a library that knows meshes makes of them for effects. Without functions nothing is made and nothing judged: parameters with the
/// annotation `Generator` (docs/running.md) are warned of (TG4080).
struct MeshAssets {
    /// Makes the file where nothing gives one, or finds it made.
    std::function<Result<std::filesystem::path>(const std::string& generator, const Mesh& mesh)> make;
    /// Refuses a file that was made for another mesh.
    std::function<Result<void>(const std::string& generator, const std::filesystem::path& file, const Mesh& mesh)> check;
    /// Which triangles a pass draws (host/run/pass_request.h); null: all of its part. Passes that draw the same get the same object.
    std::function<Result<std::shared_ptr<const DrawList>>(const PassRequest& request)> list;
    /// Refuses a compute pass that has no room for the mesh.
    std::function<Result<void>(const PassRequest& request)> fits;
};

/// Triangles of meshes over the same vertices, fewer than they have.
using FewerTriangles = std::map<const Mesh*, std::vector<std::uint32_t>>;

/// For a picture that is drawn while something moves: where a pass would draw all of a mesh that is listed here, these are drawn.
struct Coarser {
    std::shared_ptr<const FewerTriangles> triangles; // none: every mesh as it is
    bool everywhere = false;                         // otherwise into targets of the picture's size only
};

/// For a frame that may be given up: what it needs is made one after the other, and it is drawn pass by pass.
struct DrawnInPieces {
    std::function<bool()> goOn;                 // asked between two pieces; none: the frame is drawn in one
    std::map<std::string, std::uint32_t> bands; // by the pass's name: in how many bands it is drawn
    std::uint32_t others = 1;                   // bands of a pass that is not listed
};

struct RunOptions {
    std::string technique; // empty: the effect's default
    int width = 1024;      // the final target, 1..16384
    int height = 1024;
    int samples = 1; // of a pixel of the caller's targets: 1, 2, 4 or 8; the picture is their mean. The effect's own targets have one
    bool samplesAreAsked = true; // false: a technique that cannot have several (TG4039) is drawn with one
    bool halfPicture = false;    // the caller's colour target is RGBA16F, as most engines have it; otherwise RGBA32F
    Compiler compiler = Compiler::Dxc;
    std::map<std::string, std::vector<double>> parameters; // --set; wins over the workspace, which wins over the defaults
    std::map<std::string, std::string> textures;           // --set NAME=file for textures; relative to the current folder
    std::vector<std::string> dump;                         // target names; "all"
    MeshAssets assets;
    /// Albedo, linear, and the scatter mask of skin for which nothing gives a colour map (semantic DIFFUSE), with a warning. None: the
    /// effect's own Fallback.
    std::optional<std::array<float, 4>> plainSkin;
    /// Hears of each shader of a frame that was compiled: how many of all are. Never from two threads at once.
    std::function<void(std::size_t done, std::size_t total)> compiling;
    bool clearsApart = false; // clears are drawn and timed by themselves; otherwise on the way of the pass behind them
    /// What the last frame of a session left in its targets is not drawn again where it would be the same, bit for bit. Of one frame
    /// without others to warm up.
    bool keepUnchanged = false;
    Coarser coarser;
    DrawnInPieces pieces; // with `keepUnchanged`, of one frame
    int warmUpFrames = 0;
    int frames = 1; // pass times are medians over these
};

/// One mesh of a scene of several.
struct RunObject {
    const Mesh* mesh = nullptr;
    Workspace workspace; // workspaceOf(): its own textures and parameters
    Placement placement;
};

/// What is drawn: one mesh, none, or the objects of a scene. Who draws keeps pointing at them.
struct SessionScene {
    const Mesh* mesh = nullptr;
    std::span<const RunObject> objects; // where there are any, `mesh` is null
};

} // namespace tegument
