#include "host/support/whole_file.h"

#include "host/support/system.h"
#include "host/support/temporary.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tegument {

namespace fs = std::filesystem;

namespace {

/// One that no other thread, process or machine gives to its files in a shared folder; short, so that any file's name has room for it.
std::string nameOfOurOwn() {
    static std::atomic<unsigned> count = 0;
    return fmt::format(".tegument.{}.{}.{}", hostName(), processNumber(), ++count);
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

constexpr int kForAWriter = 5000; // ms: a shell opens both ends of a pipe at once

bool isPipe(int file) {
    struct stat status = {};
    return ::fstat(file, &status) == 0 && S_ISFIFO(status.st_mode);
}

/// Some bytes, 0 at the end, or below 0 with errno. Waits.
ssize_t readSome(int file, char* into, std::size_t most) {
    for (;;) {
        const ssize_t count = ::read(file, into, most);
        if (count >= 0 || (errno != EINTR && errno != EAGAIN)) return count;
        pollfd waiting{.fd = file, .events = POLLIN, .revents = 0};
        if (errno == EAGAIN) ::poll(&waiting, 1, -1);
    }
}

/// Behind what is filled. A pipe that nobody has opened yet ends at once, as one does that everybody has closed; poll tells them apart.
int readRest(int file, std::size_t most, std::string& bytes) {
    std::array<char, 1U << 16U> piece{};
    const bool pipe = isPipe(file);
    most += bytes.size();
    while (bytes.size() <= most) {
        ssize_t count = readSome(file, piece.data(), piece.size());
        pollfd waiting{.fd = file, .events = POLLIN, .revents = 0};
        const bool alone = count == 0 && pipe && bytes.empty() && ::poll(&waiting, 1, kForAWriter) == 0;
        if (count == 0 && pipe && bytes.empty()) count = readSome(file, piece.data(), piece.size());
        if (count < 0) return errno;
        if (count == 0) return alone ? ETIMEDOUT : 0;
        bytes.append(piece.data(), static_cast<std::size_t>(count));
    }
    return EFBIG;
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

int readWhole(const fs::path& path, std::size_t most, std::string& bytes) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK)); // a pipe without a writer would hold us
    if (file.number() < 0) return errno;
    std::size_t filled = 0;
    for (ssize_t count = 1; count > 0 && filled < bytes.size(); filled += static_cast<std::size_t>(count))
        if (count = readSome(file.number(), bytes.data() + filled, bytes.size() - filled); count < 0) return errno;
    bytes.resize(filled);
    return readRest(file.number(), most, bytes);
}

int writeWhole(const fs::path& path, std::string_view bytes) {
    return isSpecial(path) ? writeInto(path, bytes) : writeBeside(path, bytes);
}

int makesFileIn(const fs::path& folder) {
    if (const Descriptor nameless(::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, kForAll)); nameless.number() >= 0) return 0;
    std::string probe = (folder / ".tegument.XXXXXX").string();
    const int descriptor = ::mkstemp(probe.data());
    if (descriptor < 0) return errno;
    ::close(descriptor);
    ::unlink(probe.c_str());
    return 0;
}

} // namespace tegument
