#pragma once
// Effects of Direct3D 9 as Microsoft draws them: ID3DXEffect in Wine, of the binary that Microsoft's compiler makes of the same file,
// beside the picture of this host.

#include "host/effect/load.h"
#include "host/gpu/gpu.h"
#include "host/run/run_options.h"
#include "host/scene/workspace.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tegument {

/// What Microsoft's pictures need and this machine lacks, in words; empty when nothing.
[[nodiscard]] std::string direct3dClientMissing();

/// The Windows program that draws, with Microsoft's compiler beside it, linked into the folder: Wine takes a native library from there,
/// and d3dx9_43 wants one.
[[nodiscard]] Result<std::filesystem::path> direct3dClientIn(const std::filesystem::path& folder);

/// One effect; its files in the folder of all go by its name.
struct ReferencePicture {
    std::string name;
    std::filesystem::path file;
    LoadOptions load{};
    std::string why{}; // it is not compared; empty: it is
};

/// Draws it by this host and writes NAME.vulkan.f32 and what the client needs. Says `why` not.
void drawForReference(gpu::Device& device, ReferencePicture& picture, const Mesh* mesh, const Workspace& workspace, RunOptions options,
                      const std::filesystem::path& folder);

/// All that say no `why`, each to NAME.picture.f32. What brings the client down says so of itself, and the rest gets another client.
[[nodiscard]] Result<void> drawByMicrosoft(std::vector<ReferencePicture>& pictures, const std::filesystem::path& folder);

struct ReferenceError {
    bool black = false;  // Microsoft's picture
    double relative = 0; // L2 of the difference, by that of Microsoft's picture
    double share = 0;    // of the pixels that differ by more than two and a half of 255

    /// Edges, where coverage and filters of two rasterisers differ, are a twentieth of the pixels at most.
    [[nodiscard]] bool equal() const { return share < 0.05; }
};
/// Of what a display shows of both.
[[nodiscard]] Result<ReferenceError> referenceError(const std::filesystem::path& folder, const std::string& name);

} // namespace tegument
