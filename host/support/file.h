#pragma once
// Files: read whole, write to a temporary name and rename, cache folder, content hash.

#include "host/support/result.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

/// The file's bytes. TG5001 if it cannot be read, or has no size and no end; TG8001 if there is not as much memory.
[[nodiscard]] Result<std::string> readFile(const std::filesystem::path& path);

/// All of it. TG5001 if it has no end.
[[nodiscard]] Result<std::string> readStandardInput();

/// What `relative`, written with slashes or backslashes, names below the folder when case does not count; nullopt if there is no such file.
[[nodiscard]] std::optional<std::filesystem::path> findInAnyCase(std::filesystem::path folder, std::string relative);

/// A reader sees the old file or the whole new one, whenever this process is killed, and many writers on many machines do not meet. Links
/// are followed; pipes and devices are written into. Creates missing folders. TG5002 on failure.
[[nodiscard]] Result<void> writeFile(const std::filesystem::path& path, std::string_view bytes);

/// Whether writeFile could, asked before long work: no folder has this name, and the nearest folder above that exists takes a new file.
/// Leaves nothing behind. TG5002 if not.
[[nodiscard]] Result<void> canWrite(const std::filesystem::path& path);

/// The folder of the running program, or the nearest above it, that holds this file or folder: the tree or the build that it belongs to.
[[nodiscard]] std::optional<std::filesystem::path> folderAboveProgramWith(const std::filesystem::path& named);

/// $TEGUMENT_CACHE, else $XDG_CACHE_HOME/tegument, else $HOME/.cache/tegument.
[[nodiscard]] std::filesystem::path cacheFolder();

/// 128-bit content hash (XXH3) as 32 hex digits.
[[nodiscard]] std::string contentHash(std::string_view bytes);

} // namespace tegument
