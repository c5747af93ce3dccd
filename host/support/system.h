#pragma once
// What systems differ in, where a call is all there is to it. Each has a source: system.cpp for Linux, windows/system.cpp.
// Sources that differ as a whole (process, children, threads, whole_file) stand in windows/ under the same name.

#include <filesystem>
#include <string>
#include <vector>

namespace tegument {

[[nodiscard]] bool isTerminal(int descriptor);
/// Whether there is something to read, or an end, within the time.
[[nodiscard]] bool inputWaits(int descriptor, int milliseconds);
[[nodiscard]] std::string signalName(int signal);

[[nodiscard]] unsigned long processNumber();
[[nodiscard]] std::string hostName();
/// The running program; empty where it is not known.
[[nodiscard]] std::filesystem::path programFile();

/// Empty: it is not known.
[[nodiscard]] std::filesystem::path homeFolder();
/// Where caches go unless a variable says otherwise.
[[nodiscard]] std::filesystem::path usualCacheFolder();
/// A new folder for temporary files; without a name where none can be made.
[[nodiscard]] std::filesystem::path newTemporaryFolder();
/// At one moment; false where the file system cannot.
[[nodiscard]] bool exchangeFolders(const std::filesystem::path& a, const std::filesystem::path& b);
/// Of two names in a path: whether they are of one file. Windows takes capitals for small letters.
[[nodiscard]] bool sameName(const std::filesystem::path& a, const std::filesystem::path& b);
/// The names that a pattern with `*`, `?` and `[` fits, sorted.
[[nodiscard]] std::vector<std::string> filesLike(const std::string& pattern);
/// contentHash (file.h) of a large file; empty where it cannot be read.
[[nodiscard]] std::string contentHashOfFile(const std::filesystem::path& path);

/// "a": "liba.so", "a.dll".
[[nodiscard]] std::string libraryName(const std::string& name);
/// Loaded and never unloaded; nullptr, and why.
[[nodiscard]] void* openLibrary(const std::filesystem::path& path, std::string& why);
/// nullptr: it has none of that name.
[[nodiscard]] void* functionOf(void* library, const char* name);

} // namespace tegument
