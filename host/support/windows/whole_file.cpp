#include "host/support/whole_file.h"

#include "host/support/system.h"
#include "host/support/temporary.h"

#include <fmt/format.h>

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

/// 0, or errno.
int writeNew(const fs::path& path, std::string_view bytes) {
    errno = 0;
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    return file ? 0 : errno != 0 ? errno : EIO;
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

int writeWhole(const fs::path& path, std::string_view bytes) {
    if (isDevice(path)) return writeNew(path, bytes);
    const Temporary temporary(nameOfOurOwnIn(folderOf(path)));
    if (const int failed = writeNew(temporary.path(), bytes); failed != 0) return failed;
    constexpr DWORD kInItsPlace = MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH;
    return ::MoveFileExW(temporary.path().c_str(), path.c_str(), kInItsPlace) != 0 ? 0 : EACCES;
}

int makesFileIn(const fs::path& folder) {
    const Temporary probe(nameOfOurOwnIn(folder));
    return writeNew(probe.path(), {});
}

} // namespace tegument
