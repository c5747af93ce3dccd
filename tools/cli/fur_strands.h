#pragma once
// tegument fur strands: strands as ribbons, a part of the mesh; and the same for meshes that an effect is to draw with strands.

#include "tools/cli/commands.h"
#include "tools/cli/scene.h"

#include <filesystem>
#include <functional>

namespace tegument::app {

void addFurStrands(CLI::App& fur, Action& action);

/// Gives meshes the part "strands" where a pass of the effect draws it and they have none: from the roots that the scene names, or that
/// are made for them (fur_textures.h). A mesh with strands gets the roots of its name that lie beside it, where nothing names others.
/// `meshFile`: of a scene of one mesh. `say` is told what was made.
[[nodiscard]] Result<void> growStrands(const Effect& effect, const RunOptions& options, Scene& scene, const std::filesystem::path& meshFile,
                                       const std::function<void(const std::string&)>& say);

} // namespace tegument::app
