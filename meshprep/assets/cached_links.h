#pragma once
// Links of skin on any mesh: made when nothing names them, and kept in the cache folder, or by `tegument prep links`.

#include "meshprep/assets/generators.h"
#include "meshprep/skin/skin_links.h"

namespace tegument::assets {

/// What the annotation Generator calls them.
inline constexpr const char* kSkinLinksGenerator = "skin links";

/// The file in the cache, named by the mesh's shape and by what links are made of; made where it is not there. `say` is told.
[[nodiscard]] Result<std::filesystem::path> cachedSkinLinks(const Mesh& mesh, const Say& say);

/// The links, and beside them a JSON file that says of what mesh and profile they are. The sheet is moved out of `links`.
[[nodiscard]] Result<void> writeSkinLinks(const std::filesystem::path& file, const Mesh& mesh, SkinLinks& links,
                                          const LinkOptions& options);

/// TG4055 where the JSON file beside the links says that they were made for another mesh; links without one are taken as they are.
[[nodiscard]] Result<void> checkSkinLinks(const std::filesystem::path& file, const Mesh& mesh);

} // namespace tegument::assets
