#pragma once
// Everything about a run that needs no GPU: values, plan, compiled passes, target shapes, textures in memory. A producing effect's cache
// key is the hash of exactly this.

#include "host/effect/model.h"
#include "host/image/dds.h"
#include "host/run/plan.h"
#include "host/run/program.h"
#include "host/run/run.h"
#include "host/run/semantics.h"
#include "host/run/target_desc.h"
#include "host/run/values.h"

#include <array>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace tegument::run {

struct Prepared;

struct RunInput {
    gpu::Device& device; // producing effects run on it
    const Effect& effect;
    const Mesh* mesh = nullptr;
    const Workspace& workspace;
    const RunOptions& options;
    std::vector<std::string> producers;              // that are being run, to find circles
    const PlacedObject* placed = nullptr;            // where the mesh stands; null: alone, where its file has it
    const Prepared* before = nullptr;                // an object of the same scene: its compiled passes serve this one too
    const std::set<std::string>* uploaded = nullptr; // keys of textures that the GPU holds already
};

/// A texture that is not a target, ready for upload.
struct TextureData {
    Image image; // of a cube map: the first face; without pixels where the GPU holds it already
    gpu::Format format = gpu::Format::RGBA8;
    bool decode = false; // sRGB to linear on upload
    bool mips = false;   // the chain is to be made
    std::string key;     // equal for equal texels
    DdsTexture file;     // a cube map, or a file that brings its mip levels; else without images
};

struct Prepared {
    SceneView scene;
    Values values;
    Plan plan;
    std::map<const Pass*, PassProgram> programs;
    std::map<std::string, TargetDesc> targets; // kPicture and kPictureDepth among them
    std::map<std::string, TextureData> textures;
    std::vector<Diagnostic> warnings;
    bool drawsMesh = false;
};

/// The caller's targets are cleared to this: the workspace's background, alpha 0.
[[nodiscard]] std::array<float, 4> background(const Workspace& workspace);

/// Camera and light of a scene of several objects.
[[nodiscard]] PlacedScene placeObjects(const Workspace& workspace, std::span<const RunObject> objects);

/// Plan, programs and targets; no textures yet.
[[nodiscard]] Result<Prepared> prepare(const RunInput& input);
/// Finds and loads the textures that the plan samples, running producing effects where needed. TG4035 circular producers.
[[nodiscard]] Result<void> prepareTextures(const RunInput& input, Prepared& prepared);
/// The device holds the textures now: notes their keys, and what they took in memory is free for the next object's.
void forgetTexels(Prepared& prepared, std::set<std::string>& uploaded);

} // namespace tegument::run
