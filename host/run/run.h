#pragma once
// Runs an effect on a scene once: a session (host/run/session.h) whose picture and targets are read back.

#include "host/effect/model.h"
#include "host/gpu/gpu.h"
#include "host/image/image.h"
#include "host/run/run_options.h"
#include "host/spirv/compile.h"
#include "host/support/result.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace tegument {

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
    std::vector<std::string> parameters; // of the effect, numeric, that make a difference; sorted
    std::vector<std::string> textures;   // of the effect, sampled and not drawn
    bool produced = false;               // another effect has drawn a texture, with textures of its own
    std::vector<Diagnostic> warnings;
};

/// `mesh` may be null for effects that only draw buffers. Textures that name a producing effect (annotation `Producer =
/// "Stretch.fx/gStretchMap"`) are drawn before the first frame. Texture files are found relative to the workspace file, then the effect.
[[nodiscard]] Result<RunResult> runEffect(gpu::Device& device, const Effect& effect, const Mesh* mesh, const Workspace& workspace,
                                          const RunOptions& options);

/// The effect's script once for each object, in order, with the same targets: what it draws into the caller's targets adds up, hidden or
/// not by their common depth; those are cleared once, before the first object. Every other target belongs to one object at a time, so
/// memory does not grow with objects. The light's pyramid is fitted to each object alone: objects throw no shadow on each other.
[[nodiscard]] Result<RunResult> runScene(gpu::Device& device, const Effect& effect, std::span<const RunObject> objects,
                                         const Workspace& workspace, const RunOptions& options);

} // namespace tegument
