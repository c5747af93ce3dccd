#pragma once
// Fur on any mesh: what its effects read is made when nothing names it, and kept in the cache folder. docs/fur.md, "Made when asked for".

#include "host/app/scene.h"

#include <functional>

namespace tegument::app {

/// Generators `fur cube map` and `fur sphere map` make one map for all meshes, `fur roots` makes roots for each; a roots file of another
/// mesh is TG4055. `say` is told what was made.
[[nodiscard]] MeshTextures furTextures(std::function<void(const std::string&)> say);

/// A fur map that is made holds cones: parameters that tell a shader so get their values where the scene has none.
void setFurMapParameters(const Effect& effect, const RunOptions& options, Scene& scene);

} // namespace tegument::app
