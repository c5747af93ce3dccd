#pragma once
// Textures that are made once and kept in the cache folder, by a hash of what they are made from (CacheKey).

#include "host/support/cache.h"
#include "host/support/result.h"

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

} // namespace tegument::assets
