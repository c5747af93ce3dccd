#pragma once
// Environment maps and ambient occlusion: made when nothing names them, and kept in the cache folder; or by `tegument prep environment` and
// `tegument prep occlusion`.

#include "host/mesh/mesh.h"
#include "meshprep/assets/cache.h"

#include <filesystem>

namespace tegument::assets {

/// What the annotation Generator calls them.
inline constexpr const char* kStudioGenerator = "studio";
inline constexpr const char* kSkyGenerator = "sky";
inline constexpr const char* kOcclusionGenerator = "occlusion";

/// A default environment, by one of the first two names: a file in the cache, made where it is not there. `say` is told.
[[nodiscard]] Result<std::filesystem::path> cachedEnvironment(const std::string& generator, const Say& say);

/// The mesh's own, by its shape and texture coordinates.
[[nodiscard]] Result<std::filesystem::path> cachedOcclusion(const Mesh& mesh, const Say& say);

} // namespace tegument::assets
