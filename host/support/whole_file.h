#pragma once
// How a file comes into its place as a whole: what file.h's writeFile and canWrite stand on.

#include <filesystem>
#include <string_view>

namespace tegument {

/// Whoever reads the path finds the old content or the new one; pipes and devices are written into. 0, or errno.
[[nodiscard]] int writeWhole(const std::filesystem::path& path, std::string_view bytes);

/// Whether a file can be made in this folder; it is removed again. 0, or errno.
[[nodiscard]] int makesFileIn(const std::filesystem::path& folder);

} // namespace tegument
