#include "host/support/whole_file.h"

#include "host/support/system.h"
#include "host/support/temporary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <fstream>

#include <windows.h>

namespace tegument {

namespace fs = std::filesystem;

namespace {

fs::path nameOfOurOwnIn(const fs::path& folder) {
    static std::atomic<unsigned> count = 0;
    return folder / fmt::format(".tegument.{}.{}.{}", hostName(), processNumber(), ++count);
}

/// What GetLastError says, as errno; the C library loses it.
int failure() {
    switch (::GetLastError()) {
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL: return ENOSPC;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
    case ERROR_WRITE_PROTECT: return EACCES;
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND: return ENOENT;
    default: return EIO;
    }
}

/// 0, or errno.
int writeNew(const fs::path& path, std::string_view bytes) {
    constexpr std::size_t kMostAtOnce = 1U << 30U;
    const HANDLE file = ::CreateFileW(path.c_str(), GENERIC_WRITE, FILE_SHARE_READ, nullptr, CREATE_ALWAYS, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (file == INVALID_HANDLE_VALUE) return failure();
    int failed = 0;
    while (!bytes.empty() && failed == 0) {
        DWORD written = 0;
        if (::WriteFile(file, bytes.data(), static_cast<DWORD>(std::min(bytes.size(), kMostAtOnce)), &written, nullptr) == 0)
            failed = failure();
        bytes.remove_prefix(written);
    }
    if (::CloseHandle(file) == 0 && failed == 0) failed = failure();
    return failed;
}

bool isDevice(const fs::path& path) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    return path.filename() == "NUL" || (!code && fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status));
}

fs::path folderOf(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

} // namespace

int readWhole(const fs::path& path, std::size_t most, std::string& bytes) {
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in.is_open()) return errno != 0 ? errno : EIO;
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    most += bytes.size();
    for (std::array<char, 1U << 16U> piece{}; in && bytes.size() <= most;) {
        in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        bytes.append(piece.data(), static_cast<std::size_t>(in.gcount()));
    }
    if (in.bad()) return EIO;
    return bytes.size() > most ? EFBIG : 0;
}

int writeWhole(const fs::path& path, std::string_view bytes) {
    if (isDevice(path)) return writeNew(path, bytes);
    const Temporary temporary(nameOfOurOwnIn(folderOf(path)));
    if (const int failed = writeNew(temporary.path(), bytes); failed != 0) return failed;
    constexpr DWORD kInItsPlace = MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH;
    return ::MoveFileExW(temporary.path().c_str(), path.c_str(), kInItsPlace) != 0 ? 0 : failure();
}

int makesFileIn(const fs::path& folder) {
    const Temporary probe(nameOfOurOwnIn(folder));
    return writeNew(probe.path(), {});
}

} // namespace tegument
