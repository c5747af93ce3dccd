#pragma once
// Surroundings and ambient occlusion: made when nothing names them, and kept in the cache folder; or by `tegument prep environment` and
// `tegument prep occlusion`.

#include "host/mesh/mesh.h"
#include "host/support/result.h"

#include <filesystem>
#include <functional>

namespace tegument::app {

/// What the annotation Generator calls them.
inline constexpr const char* kStudioGenerator = "studio";
inline constexpr const char* kSkyGenerator = "sky";
inline constexpr const char* kOcclusionGenerator = "occlusion";

using SaySurroundings = std::function<void(const std::string&)>;

/// A default environment, by one of the first two names: a file in the cache, made where it is not there. `say` is told.
[[nodiscard]] Result<std::filesystem::path> cachedEnvironment(const std::string& generator, const SaySurroundings& say);

/// The mesh's own, by its shape and texture coordinates.
[[nodiscard]] Result<std::filesystem::path> cachedOcclusion(const Mesh& mesh, const SaySurroundings& say);

} // namespace tegument::app
