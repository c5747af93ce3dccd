#include "host/support/file.h"

#include "host/support/kept_inputs.h"
#include "host/support/system.h"
#include "host/support/text.h"
#include "host/support/whole_file.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <set>
#include <system_error>
#include <vector>

namespace tegument {

namespace fs = std::filesystem;

namespace {

/// Of what has no size, and of what is behind the size that a file had: /dev/zero has no end.
constexpr std::size_t kMostOfAStream = std::size_t{1} << 30;

Error unreadable(const fs::path& path, int failed) {
    const SourcePosition at{.file = path.string()};
    if (failed == EFBIG)
        return inputError(5001, at, fmt::format("gives more than {} MiB and has no size of its own", kMostOfAStream >> 20),
                          "put what it holds into a file");
    if (failed == ETIMEDOUT) return inputError(5001, at, "is a pipe, and nobody writes into it", "start what writes before this command");
    return inputError(5001, at, fmt::format("cannot be read: {}", std::strerror(failed)));
}

} // namespace

Result<std::string> readFile(const fs::path& path) {
    std::error_code code;
    if (fs::is_directory(path, code)) return inputError(5001, {.file = path.string()}, "is a folder, not a file");
    if (const auto noted = kept::noteRead(path); !noted) return noted.error();
    const auto size = fs::file_size(path, code); // unknown for a pipe, and 0 under /proc: the rest is read piece by piece
    std::string bytes;
    try {
        if (!code) bytes.resize(size);
        if (const int failed = readWhole(path, kMostOfAStream, bytes); failed != 0) return unreadable(path, failed);
    } catch (const std::exception&) { // bad_alloc, or length_error: a sparse file may be of any size
        const std::string many = code ? std::string() : fmt::format(", which has {} MiB", size >> 20);
        return machineError(8001, fmt::format("out of memory for {}{}", path.string(), many),
                            "try a smaller file, or a larger --max-memory");
    }
    return bytes;
}

Result<std::string> readStandardInput() {
    std::string bytes;
    for (std::array<char, 1U << 16U> piece{}; std::cin && bytes.size() <= kMostOfAStream;) {
        std::cin.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        bytes.append(piece.data(), static_cast<std::size_t>(std::cin.gcount()));
    }
    if (std::cin.bad()) return unreadable("standard input", EIO);
    if (bytes.size() > kMostOfAStream) return unreadable("standard input", EFBIG);
    return bytes;
}

namespace {

constexpr std::size_t kMostWays = 64; // bounds what links to folders above can do

/// Where each of these folders has this name in any case: as it is written first, the others in their order.
std::vector<fs::path> ways(const std::vector<fs::path>& folders, const fs::path& name) {
    std::vector<fs::path> exact;
    std::set<fs::path> others;
    std::error_code error;
    for (const fs::path& folder : folders) {
        if (name == ".." || name == "." || name.empty() || fs::exists(folder / name, error)) exact.push_back(folder / name);
        for (fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error), end; !error && entry != end;
             entry.increment(error))
            if (const fs::path own = entry->path().filename(); own != name && equalsIgnoreCase(own.string(), name.string()))
                others.insert(folder / own);
    }
    exact.insert(exact.end(), others.begin(), others.end());
    exact.resize(std::min(exact.size(), kMostWays));
    return exact;
}

} // namespace

std::optional<fs::path> findInAnyCase(fs::path folder, std::string relative) {
    std::ranges::replace(relative, '\\', '/');
    const auto isFile = [](const fs::path& path) {
        std::error_code error;
        return fs::is_regular_file(path, error);
    };
    const fs::path asWritten = fs::path(relative).lexically_normal();
    if (isFile(folder / asWritten)) return (folder / asWritten).lexically_normal();
    std::vector<fs::path> found = {std::move(folder)};
    for (const fs::path& part : asWritten) // folders whose names differ in case alone may both be there
        found = ways(found, part);
    const auto file = std::ranges::find_if(found, isFile);
    return file == found.end() ? std::nullopt : std::optional(file->lexically_normal());
}

namespace {

Error unwritable(const fs::path& path, const std::string& why) {
    const std::string cache = cacheFolder().string();
    const bool inCache = path.string().starts_with(cache + '/');
    return machineError(5002, fmt::format("cannot write {}: {}", path.string(), why),
                        inCache ? "that is the cache; TEGUMENT_CACHE=FOLDER takes another" : "check the folder's rights and free space");
}

} // namespace

Result<void> canWrite(const fs::path& path) {
    std::error_code code;
    if (fs::is_directory(path, code)) return unwritable(path, "it is a folder");
    if (const auto may = kept::mayWrite(path); !may) return may.error();
    fs::path folder = path.parent_path();
    while (!folder.empty() && !fs::exists(folder, code))
        folder = folder == folder.parent_path() ? fs::path() : folder.parent_path();
    if (folder.empty()) folder = ".";
    if (!fs::is_directory(folder, code)) return unwritable(path, folder.string() + " is not a folder");
    const int failed = makesFileIn(folder);
    return failed == 0 ? Result<void>() : unwritable(path, std::strerror(failed));
}

Result<void> writeFile(const fs::path& path, std::string_view bytes) {
    if (auto may = kept::mayWrite(path); !may) return may;
    return rewriteFile(path, bytes);
}

Result<void> rewriteFile(const fs::path& path, std::string_view bytes) {
    std::error_code code;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), code);
    if (code) return unwritable(path, code.message());
    if (fs::is_directory(path, code)) return unwritable(path, "it is a folder");
    fs::path target = path;
    if (fs::is_symlink(path, code) && fs::exists(path, code)) target = fs::canonical(path, code); // a link stays one
    if (const int failed = writeWhole(target, bytes); failed != 0) return unwritable(path, std::strerror(failed));
    kept::noteWritten(path);
    return {};
}

std::optional<fs::path> folderAboveProgramWith(const fs::path& named) {
    std::error_code code;
    if (named.empty()) return std::nullopt;
    for (fs::path folder = programFile().parent_path(); folder.has_relative_path(); folder = folder.parent_path())
        if (fs::exists(folder / named, code)) return folder;
    return std::nullopt;
}

fs::path cacheFolder() {
    const auto variable = [](const char* name) -> std::string {
        const char* value = std::getenv(name);
        return value ? value : "";
    };
    if (const std::string own = variable("TEGUMENT_CACHE"); !own.empty()) return own;
    if (const std::string xdg = variable("XDG_CACHE_HOME"); !xdg.empty()) return fs::path(xdg) / "tegument";
    return usualCacheFolder();
}

std::string contentHash(std::string_view bytes) {
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

} // namespace tegument
