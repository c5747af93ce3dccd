#include "tools/direct3d/wine.h"

#include "host/support/file.h"

#include <fmt/format.h>

#include <cstdlib>
#include <mutex>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace tegument {

namespace fs = std::filesystem;

namespace {

constexpr double kPrefixSeconds = 180;
constexpr double kDisplaySeconds = 20;

Error wineFailure(std::string what, std::string hint = {}) {
    return machineError(3104, std::move(what), std::move(hint));
}

std::string ownDisplay() {
    const char* display = std::getenv("DISPLAY");
    return display == nullptr ? "" : display;
}

/// One Xvfb for every Wine process of this program. Without a display Wine leaves a server behind that cannot open windows ever after.
class Display {
public:
    Result<std::string> name() {
        if (const std::string own = ownDisplay(); !own.empty()) return own;
        if (server_ && server_->running()) return name_;
        server_.reset();
        auto started =
            BackgroundProcess::start({.arguments = {"Xvfb", "-displayfd", "1", "-screen", "0", "1280x1024x24", "-nolisten", "tcp"}});
        if (!started) return started.error();
        for (auto line = started->readLine(kDisplaySeconds); line; line = started->readLine(kDisplaySeconds)) {
            if (line->find_first_not_of("0123456789") != std::string::npos || line->empty()) continue; // a warning on the same pipe
            server_ = std::move(*started);
            name_ = ":" + *line;
            return name_;
        }
        return wineFailure("Xvfb opened no display", "try `Xvfb -displayfd 1` by hand");
    }

private:
    std::optional<BackgroundProcess> server_;
    std::string name_;
};

/// Held by the process that creates the prefix, across processes.
class FileLock {
public:
    explicit FileLock(const fs::path& path) : file_(open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644)) {
        if (file_ >= 0) flock(file_, LOCK_EX);
    }
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;
    ~FileLock() {
        if (file_ >= 0) close(file_);
    }

private:
    int file_;
};

fs::path prefixFolder() {
    std::error_code code;
    return fs::absolute(cacheFolder() / "wine", code);
}

ProcessCommand wineCommand(std::vector<std::string> arguments, const std::string& display) {
    arguments.insert(arguments.begin(), "wine");
    return {.arguments = std::move(arguments),
            .environment = {{"WINEPREFIX", prefixFolder().string()},
                            {"WINEDEBUG", "-all"},
                            // Microsoft's compiler instead of Wine's own; no .NET, no browser, no debugger that waits for a click
                            {"WINEDLLOVERRIDES", "d3dcompiler_47=n;mscoree,mshtml=;winedbg.exe="},
                            // Direct3D in the calling thread: Wine's second one, and the first while it waits, spin. Of the time of a
                            // client that draws small pictures on two cores that was three quarters.
                            {"WINE_D3D_CONFIG", "csmt=0x0"},
                            {"LC_ALL", "C.UTF-8"},
                            {"TMPDIR", ""}, // or Wine 10 (Debian 13) ends with "free(): invalid pointer", whatever its value
                            {"DISPLAY", display}}};
}

Result<void> preparePrefix(const std::string& display) {
    const fs::path prefix = prefixFolder();
    std::error_code code;
    if (fs::exists(prefix / "system.reg", code)) return {};
    fs::create_directories(prefix, code);
    if (code) return wineFailure(fmt::format("cannot create {}: {}", prefix.string(), code.message()));
    const FileLock lock(prefix.string() + ".lock");
    if (fs::exists(prefix / "system.reg", code)) return {};
    const auto boot = runProcess(wineCommand({"wineboot", "-i"}, display), kPrefixSeconds);
    if (!boot) return boot.error();
    if (boot->timedOut || boot->exitCode != 0)
        return wineFailure(fmt::format("Wine could not set up {}: {}", prefix.string(), boot->timedOut ? "it took too long" : boot->output),
                           "remove that folder and try again");
    return {};
}

} // namespace

std::string wineMissing() {
    if (!findProgram("wine")) return "wine is not installed (./bootstrap test installs it)";
    if (ownDisplay().empty() && !findProgram("Xvfb")) return "Xvfb is not installed and there is no DISPLAY (./bootstrap test installs it)";
    return {};
}

Result<ProcessCommand> wineProcess(const fs::path& program, const std::vector<std::string>& arguments) {
    static std::mutex mutex;
    static Display display;
    const std::scoped_lock lock(mutex);
    const auto name = display.name();
    if (!name) return name.error();
    if (const auto prepared = preparePrefix(*name); !prepared) return prepared.error();
    std::vector<std::string> all{program.string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return wineCommand(std::move(all), *name);
}

Result<ProcessResult> runInWine(const fs::path& program, const std::vector<std::string>& arguments, double timeoutSeconds) {
    const auto command = wineProcess(program, arguments);
    if (!command) return command.error();
    return runProcess(*command, timeoutSeconds);
}

} // namespace tegument
