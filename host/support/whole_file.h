#pragma once
// Files are read whole, and appear whole: what readFile, writeFile and canWrite of file.h stand on.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace tegument {

/// `bytes` comes with the size that the file is said to have, and leaves with what is in it: at most `most` bytes more, else EFBIG. Waits
/// for who writes into a pipe; ETIMEDOUT where nobody opens it within five seconds. 0, or errno.
[[nodiscard]] int readWhole(const std::filesystem::path& path, std::size_t most, std::string& bytes);

/// Whoever reads the path finds the old content or the new one; pipes and devices are written into. 0, or errno.
[[nodiscard]] int writeWhole(const std::filesystem::path& path, std::string_view bytes);

/// Whether a file can be made in this folder; it is removed again. 0, or errno.
[[nodiscard]] int makesFileIn(const std::filesystem::path& folder);

} // namespace tegument
