#include "host/support/file.h"

#include "host/support/temporary.h"
#include "host/support/text.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tegument {

namespace fs = std::filesystem;

Result<std::string> readFile(const fs::path& path) {
    std::error_code code;
    if (fs::is_directory(path, code)) return inputError(5001, {.file = path.string(), .byte = {}}, "is a folder, not a file");
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    std::string bytes;
    const auto size = fs::file_size(path, code); // unknown for a pipe, and 0 under /proc: the rest is read piece by piece
    if (!code && in.is_open()) {
        bytes.resize(size);
        in.read(bytes.data(), static_cast<std::streamsize>(size));
        bytes.resize(static_cast<std::size_t>(in.gcount()));
    }
    if (in) bytes.append(std::istreambuf_iterator<char>(in), {});
    if (!in.is_open() || in.bad()) {
        return inputError(5001, {.file = path.string(), .byte = {}}, fmt::format("cannot be read: {}", std::strerror(errno ? errno : EIO)));
    }
    return bytes;
}

std::optional<fs::path> findInAnyCase(fs::path folder, std::string relative) {
    std::ranges::replace(relative, '\\', '/');
    std::error_code error;
    for (const fs::path& part : fs::path(relative).lexically_normal()) {
        const fs::path exact = folder / part;
        if (part == ".." || part == "." || part.empty() || fs::exists(exact, error)) {
            folder = exact;
            continue;
        }
        std::optional<fs::path> next;
        for (fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error), end; !error && entry != end;
             entry.increment(error))
            if (equalsIgnoreCase(entry->path().filename().string(), part.string())) next = entry->path().filename();
        if (!next) return std::nullopt;
        folder /= *next;
    }
    return fs::is_regular_file(folder, error) ? std::optional(folder.lexically_normal()) : std::nullopt;
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
    fs::path folder = path.parent_path();
    while (!folder.empty() && !fs::exists(folder, code))
        folder = folder == folder.parent_path() ? fs::path() : folder.parent_path();
    if (folder.empty()) folder = ".";
    if (!fs::is_directory(folder, code)) return unwritable(path, folder.string() + " is not a folder");
    std::string probe = (folder / ".tegument.XXXXXX").string();
    const int descriptor = ::mkstemp(probe.data());
    if (descriptor < 0) return unwritable(path, std::strerror(errno));
    ::close(descriptor);
    ::unlink(probe.c_str());
    return {};
}

namespace {

/// One that no other thread, process or machine gives to its files in a shared folder; short, so that any file's name has room for it.
std::string nameOfOurOwn() {
    static std::atomic<unsigned> count = 0;
    std::array<char, 256> host{};
    if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
    return fmt::format(".tegument.{}.{}.{}", host.data(), ::getpid(), ++count);
}

class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { (void)close(); }
    [[nodiscard]] int number() const { return number_; }
    /// Some file systems say only now that the disk is full.
    [[nodiscard]] bool close() { return number_ < 0 || ::close(std::exchange(number_, -1)) == 0; }

private:
    int number_;
};

bool writeAll(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

constexpr mode_t kForAll = 0666; // less what umask takes

enum class Named { No, InPlace, Beside };

/// A file without a name gets one when it is whole: killed before, it leaves nothing. Beside its place where another file stands there, and
/// not at all where there is no /proc.
Named nameIt(int file, const fs::path& path, const fs::path& beside) {
    const std::string open = fmt::format("/proc/self/fd/{}", file);
    const auto link = [&](const fs::path& to) { return ::linkat(AT_FDCWD, open.c_str(), AT_FDCWD, to.c_str(), AT_SYMLINK_FOLLOW) == 0; };
    if (link(path)) return Named::InPlace;
    return link(beside) ? Named::Beside : Named::No;
}

/// Pipes and devices have no old content to keep, and must not be replaced by a file.
bool isSpecial(const fs::path& path) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    return !code && fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// 0, or errno.
int writeInto(const fs::path& path, std::string_view bytes) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    return file.number() >= 0 && writeAll(file.number(), bytes) && file.close() ? 0 : errno;
}

/// 0, or errno.
int writeNamed(const fs::path& path, std::string_view bytes) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kForAll));
    return file.number() >= 0 && writeAll(file.number(), bytes) && file.close() ? 0 : errno;
}

/// 0, or errno.
int writeBeside(const fs::path& path, std::string_view bytes) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const Temporary temporary(folder / nameOfOurOwn());
    Named named = Named::No;
    Descriptor nameless(::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, kForAll));
    if (nameless.number() >= 0) {
        if (!writeAll(nameless.number(), bytes)) return errno;
        named = nameIt(nameless.number(), path, temporary.path());
        if (!nameless.close()) return errno;
    }
    if (named == Named::InPlace) return 0;
    if (named == Named::No)
        if (const int failed = writeNamed(temporary.path(), bytes); failed != 0) return failed;
    return ::rename(temporary.path().c_str(), path.c_str()) == 0 ? 0 : errno;
}

} // namespace

Result<void> writeFile(const fs::path& path, std::string_view bytes) {
    std::error_code code;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), code);
    if (code) return unwritable(path, code.message());
    if (fs::is_directory(path, code)) return unwritable(path, "it is a folder");
    fs::path target = path;
    if (fs::is_symlink(path, code) && fs::exists(path, code)) target = fs::canonical(path, code); // a link stays one
    const int failed = isSpecial(target) ? writeInto(target, bytes) : writeBeside(target, bytes);
    if (failed != 0) return unwritable(path, std::strerror(failed));
    return {};
}

fs::path cacheFolder() {
    const auto variable = [](const char* name) -> std::string {
        const char* value = std::getenv(name);
        return value ? value : "";
    };
    if (const std::string own = variable("TEGUMENT_CACHE"); !own.empty()) return own;
    if (const std::string xdg = variable("XDG_CACHE_HOME"); !xdg.empty()) return fs::path(xdg) / "tegument";
    const std::string home = variable("HOME");
    return fs::path(home.empty() ? "/tmp" : home) / ".cache" / "tegument";
}

std::string contentHash(std::string_view bytes) {
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

} // namespace tegument
