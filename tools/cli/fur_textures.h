#pragma once
// Textures that belong to a mesh, for fur and for skin: what effects read is made when nothing names it, and kept in the cache folder
// (docs/running.md).

#include "tools/cli/scene.h"

#include <functional>

namespace tegument::app {

/// Annotations Generator of textures of roots: on the whole mesh, and on a head where hair grows (meshprep/fur/roots/head_hair.h).
inline constexpr const char* kRootsGenerator = "fur roots";
inline constexpr const char* kHairGenerator = "hair roots";

/// Generators `fur cube map` and `fur sphere map` make one map for all meshes, `fur roots` and `skin links` a file for each; one of another
/// mesh is TG4055. `say` is told what was made.
[[nodiscard]] MeshTextures furTextures(std::function<void(const std::string&)> say);

/// A fur map that is made holds cones: parameters that tell a shader so get their values where the scene has none.
void setFurMapParameters(const Effect& effect, const RunOptions& options, Scene& scene);

} // namespace tegument::app
