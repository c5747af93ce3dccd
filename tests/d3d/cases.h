#pragma once
// What is drawn: every technique of every effect, on one scene, by every engine. Where the drawings are.

#include "host/effect/model.h"
#include "host/image/image.h"
#include "host/mesh/mesh.h"
#include "host/scene/workspace.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace tegument::test {

/// Maps and picture are small: llvmpipe draws them. The picture is not square and of another size than the maps, so that a half pixel taken
/// from the wrong target, or a depth target of the wrong size, shows.
inline constexpr int kMapSize = 256;
inline constexpr int kPictureWidth = 288;
inline constexpr int kPictureHeight = 240;

struct Case {
    std::filesystem::path effect;
    std::string technique;
    int mapBits = 16;                                  // TEGUMENT_MAP_BITS
    std::vector<std::filesystem::path> includeFolders; // searched besides the effect's own
    bool computes = false;                             // some pass has a compute shader
    int lamps = 0;                                     // TEGUMENT_LAMPS
    bool soft = false;                                 // TEGUMENT_SOFT_SHADOWS
    bool surroundings = false;                         // TEGUMENT_SURROUNDINGS
    bool half = false;                                 // TEGUMENT_POST_HALF

    /// Of what is compiled once for all techniques.
    [[nodiscard]] std::string effectName() const {
        const std::string lit = lamps == 0 ? "" : "Lamps" + std::to_string(lamps);
        return effect.stem().string() + (mapBits == 16 ? "" : "32") + lit + (soft ? "Soft" : "") + (surroundings ? "Around" : "") +
               (half ? "Half" : "");
    }
    [[nodiscard]] std::string name() const { return effectName() + "_" + technique; }
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> defines() const;
};

enum class Engine { Vulkan, Direct3D9, Direct3D10, Direct3D11, Direct3D12 };
inline constexpr std::array kDirect3D = {Engine::Direct3D9, Engine::Direct3D10, Engine::Direct3D11, Engine::Direct3D12};
std::string engineName(Engine engine); // "d3d9"

/// The effect as all engines get it.
[[nodiscard]] Result<Effect> loadCase(const Case& drawn);
/// From the files: effects/*.fx and the techniques that they hold, and one technique of each of effects/peers. Those of Convolution.fx also
/// with maps of 32 bits: what differs between engines in the cascade of 16-bit maps must vanish there. Main.fx also with one lamp,
/// Pyramid.fx with three that have penumbras, SkinPost.fx at half resolution. The client of the library comes last.
[[nodiscard]] const std::vector<Case>& allCases();

/// They are drawn in parts, one process after the other: from 1. What is compiled together, and what is compared, is in one part.
inline constexpr int kParts = TEGUMENT_DRAWING_PARTS;
[[nodiscard]] int partOf(const Case& drawn);

/// tests/library/Skin.fx, skin by tegument.hlsl alone: for engines that take entry points.
[[nodiscard]] const Case& libraryCase();
/// Compute shaders and compiled entry points are not for Direct3D 9 and 10; penumbras are not for Direct3D 9. Cube maps
/// of fur are not for Direct3D 12 in Wine 8: its vkd3d ends the program with an assertion while it reads the shader.
[[nodiscard]] bool drawnBy(const Case& drawn, Engine engine);

/// The human where it was made (./bootstrap test), with its maps reduced; else a sphere.
[[nodiscard]] Result<Mesh> testMesh();
/// Of radius 1, with one chart: what effects of other hosts are drawn on.
[[nodiscard]] Mesh ball();
/// A portrait; its background has values that Direct3D 9 can clear to, eight bits a channel.
[[nodiscard]] Workspace testWorkspace();

/// All drawings, of one build of the tests.
[[nodiscard]] std::filesystem::path drawings();
[[nodiscard]] std::filesystem::path drawing(const Case& drawn, Engine engine, const std::string& target);
/// "ok", or why there is no drawing.
[[nodiscard]] std::filesystem::path statusFile(const Case& drawn, Engine engine);

/// Why nothing was drawn; there is no such file otherwise.
[[nodiscard]] std::filesystem::path missingFile();

} // namespace tegument::test
