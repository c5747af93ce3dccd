#include "host/support/system.h"

#include "host/support/file.h"

#include <array>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <fcntl.h>
#include <glob.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tegument {

namespace fs = std::filesystem;

bool isTerminal(int descriptor) {
    return ::isatty(descriptor) == 1;
}

bool inputWaits(int descriptor, int milliseconds) {
    pollfd wanted{.fd = descriptor, .events = POLLIN, .revents = 0};
    return ::poll(&wanted, 1, milliseconds) != 0; // an interruption counts as something: the caller asks again
}

std::string signalName(int signal) {
    return ::strsignal(signal);
}

unsigned long processNumber() {
    return static_cast<unsigned long>(::getpid());
}

std::string hostName() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

fs::path programFile() {
    std::error_code code;
    return fs::read_symlink("/proc/self/exe", code);
}

fs::path homeFolder() {
    const char* home = std::getenv("HOME");
    return home == nullptr ? "" : home;
}

fs::path usualCacheFolder() {
    const fs::path home = homeFolder();
    return (home.empty() ? fs::path("/tmp") : home) / ".cache" / "tegument";
}

fs::path newTemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "tegument-XXXXXX").string();
    return ::mkdtemp(pattern.data()) != nullptr ? pattern : "";
}

bool exchangeFolders(const fs::path& a, const fs::path& b) {
    return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
}

bool sameName(const fs::path& a, const fs::path& b) {
    return a == b;
}

std::vector<std::string> filesLike(const std::string& pattern) {
    glob_t found{};
    std::vector<std::string> all;
    if (::glob(pattern.c_str(), 0, nullptr, &found) == 0) all.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    ::globfree(&found);
    return all;
}

/// Mapped rather than read: 35 MB in 5 ms instead of 60.
std::string contentHashOfFile(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat status = {};
    std::string hash;
    if (file >= 0 && ::fstat(file, &status) == 0 && status.st_size > 0) {
        const auto size = static_cast<std::size_t>(status.st_size);
        void* bytes = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
        if (bytes != MAP_FAILED) {
            hash = contentHash({static_cast<const char*>(bytes), size});
            ::munmap(bytes, size);
        }
    }
    if (file >= 0) ::close(file);
    return hash;
}

std::string libraryName(const std::string& name) {
    return "lib" + name + ".so";
}

void* openLibrary(const fs::path& path, std::string& why) {
    void* library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) why = ::dlerror();
    return library;
}

void* functionOf(void* library, const char* name) {
    return ::dlsym(library, name);
}

} // namespace tegument
