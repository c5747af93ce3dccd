#pragma once
// Everything about a run that needs no GPU: values, plan, compiled passes, target shapes, textures in memory.

#include "host/effect/model.h"
#include "host/image/dds.h"
#include "host/run/plan.h"
#include "host/run/program.h"
#include "host/run/run_options.h"
#include "host/run/semantics.h"
#include "host/run/session_frame.h"
#include "host/run/target_desc.h"
#include "host/run/texture_source.h"
#include "host/run/values.h"

#include <array>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace tegument::run {

/// A texture that is not a target, ready for upload.
struct TextureData {
    Image image; // of a cube map: the first face; without pixels where the GPU holds it already, or RunInput::loaded does
    PixelFormat format = PixelFormat::RGBA8;
    bool decode = false; // sRGB to linear on upload
    bool mips = false;   // the chain is to be made
    std::string key;     // equal for equal texels
    DdsTexture file;     // a cube map, or a file that brings its mip levels; else without images
};

/// Files that were made for a mesh by their annotation Generator, and given files that were found to be made from it. To find out, all of
/// the mesh and of the file must be read.
struct KnownFiles {
    std::map<std::pair<const Mesh*, std::string>, std::filesystem::path> made;
    std::set<std::tuple<const Mesh*, std::string, std::filesystem::path>> checked;
};

/// One effect on one mesh, or on none.
struct RunInput {
    const Effect& effect;
    const Mesh* mesh = nullptr;
    const Workspace& workspace;
    const RunOptions& options;
    const PlacedObject* placed = nullptr;                       // where the mesh stands; null: alone, where its file has it
    const Programs* compiled = nullptr;                         // of earlier frames and objects
    const std::set<std::string>* uploaded = nullptr;            // keys of textures that the GPU holds already
    const std::map<std::string, TextureData>* loaded = nullptr; // by key: read already, to be uploaded
    KnownFiles* known = nullptr;                                // of frames before, and for the next
};

struct Prepared {
    SceneView scene;
    Values values;
    Plan plan;
    Programs programs;
    std::map<std::string, TargetDesc> targets; // kPicture and kPictureDepth among them
    std::map<std::string, TextureData> textures;
    std::map<std::string, ProducerSource> products; // textures that other effects draw (host/run/products.h)
    std::map<std::string, std::string> origins;     // of both: "file skin.png", for people
    std::map<std::string, Bake> bakes;              // of textures that are made from the mesh
    std::set<std::string> reads; // numeric parameters that make a difference: to shaders, scripts, and effects that draw textures for it
    std::vector<Diagnostic> warnings;
    bool drawsMesh = false;
};

/// The caller's targets are cleared to this: the workspace's background, alpha 0.
[[nodiscard]] std::array<float, 4> background(const Workspace& workspace);

/// Camera and light of a scene of several objects.
[[nodiscard]] PlacedScene placeObjects(const Workspace& workspace, std::span<const RunObject> objects);

/// Plan, programs and targets; no textures yet.
[[nodiscard]] Result<Prepared> prepare(const RunInput& input);
/// Finds the textures that the plan samples, and loads those that are files, or in the mesh, or constants.
[[nodiscard]] Result<void> prepareTextures(const RunInput& input, Prepared& prepared);
/// The device holds the textures now: notes their keys, and what they took in memory is free for the next object's.
void forgetTexels(Prepared& prepared, std::set<std::string>& uploaded);

} // namespace tegument::run
