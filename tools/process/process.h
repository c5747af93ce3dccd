#pragma once
// Other programs: run to the end with a time limit, or beside us until we are done. No shell in between, so that no name needs quoting.

#include "host/support/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace tegument {

struct ProcessCommand {
    std::vector<std::string> arguments;                           // the first is the program: a path, or a name looked up in $PATH
    std::vector<std::pair<std::string, std::string>> environment; // in place of our own; without a value: not passed on
    bool errorsApart = false;                                     // keep what it says on stderr by itself
    std::size_t maxBytes = 0;                                     // of memory that it may write; 0: as much as it wants
};

struct ProcessResult {
    int exitCode = 0; // 128 + n when signal n ended it
    bool timedOut = false;
    std::string output; // stdout and stderr as they came; of each at most 64 MiB
    std::string errors; // stderr, where it was asked for apart
    double processorSeconds = 0;
    std::size_t peakBytes = 0; // most memory that it, or a program that it ran, held at a time
};

/// The program's file, if there is one that we may execute.
[[nodiscard]] std::optional<std::filesystem::path> findProgram(const std::string& name);

/// Runs to the end, or kills the whole process group after `timeoutSeconds`. TG5003 if it cannot be started, or if its exit code is lost
/// because the process ignores SIGCHLD.
[[nodiscard]] Result<ProcessResult> runProcess(const ProcessCommand& command, double timeoutSeconds);

/// Runs beside us, whichever thread started it; ended with its process group on destruction, and by the system when we die. Its number is
/// given back on destruction only: no other process is ever signalled in its place.
class BackgroundProcess {
public:
    /// TG5003 if it cannot be started.
    [[nodiscard]] static Result<BackgroundProcess> start(const ProcessCommand& command);
    BackgroundProcess(BackgroundProcess&& other) noexcept;
    BackgroundProcess& operator=(BackgroundProcess&& other) noexcept;
    BackgroundProcess(const BackgroundProcess&) = delete;
    BackgroundProcess& operator=(const BackgroundProcess&) = delete;
    ~BackgroundProcess();

    /// The next line of its output; nothing when it ends or the time is over first.
    [[nodiscard]] std::optional<std::string> readLine(double timeoutSeconds);
    [[nodiscard]] bool running();

private:
    BackgroundProcess(pid_t id, int output) : id_(id), output_(output) {}
    void stop();

    pid_t id_ = -1;
    int output_ = -1;
    std::string pending_; // read, but behind the line that was asked for
};

} // namespace tegument
