#pragma once
// How a file is read whole and comes into its place as a whole: what file.h's readFile, writeFile and canWrite stand on.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace tegument {

/// Fills the bytes, which are as many as the file is thought to hold, and cuts them to what there is. Goes on behind them for at most
/// `most` more: EFBIG beyond. A pipe is waited for while somebody writes; ETIMEDOUT: nobody began to within some seconds. 0, or errno.
[[nodiscard]] int readWhole(const std::filesystem::path& path, std::size_t most, std::string& bytes);

/// Whoever reads the path finds the old content or the new one; pipes and devices are written into. 0, or errno.
[[nodiscard]] int writeWhole(const std::filesystem::path& path, std::string_view bytes);

/// Whether a file can be made in this folder; it is removed again. 0, or errno.
[[nodiscard]] int makesFileIn(const std::filesystem::path& folder);

} // namespace tegument
