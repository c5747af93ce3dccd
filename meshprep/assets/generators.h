#pragma once
// Textures by the annotation Generator, for fur, skin and light: made when nothing names them, and cached in the cache folder
// (docs/running.md).

#include "meshprep/assets/scene.h"

#include <filesystem>
#include <functional>
#include <string>

namespace tegument::assets {

/// Is told what was made, in how many seconds, and where it lies.
using Say = std::function<void(const std::string&)>;

/// FOLDER/made/NAME.dds of the cache folder: `make` writes it where it is absent or cut short. `what`: for `say`.
[[nodiscard]] Result<std::filesystem::path> cachedDds(const std::string& folder, const std::string& name, const std::string& what,
                                                      const Say& say,
                                                      const std::function<Result<void>(const std::filesystem::path&)>& make);

/// Annotations Generator of textures of roots: on the whole mesh, and on a head where hair grows (meshprep/fur/roots/head_hair.h).
inline constexpr const char* kRootsGenerator = "fur roots";
inline constexpr const char* kHairGenerator = "hair roots";

/// Generators `fur cube map` and `fur sphere map` make one map for all meshes, `fur roots` and `skin links` a file for each; one of another
/// mesh is TG4055. `say` is told what was made.
[[nodiscard]] MeshAssets meshAssets(Say say = {});

/// A fur map that is made holds cones: parameters that tell a shader so get their values where the scene has none.
void setFurMapParameters(const Effect& effect, const RunOptions& options, Scene& scene);

} // namespace tegument::assets
