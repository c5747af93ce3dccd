#include "host/support/process.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tegument {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

Clock::time_point after(double seconds) {
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

int millisecondsUntil(Clock::time_point end) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    return static_cast<int>(std::clamp<long long>(left, 0, 60'000));
}

/// Our environment with the command's variables in place of ours.
std::vector<std::string> mergedEnvironment(const ProcessCommand& command) {
    std::vector<std::string> merged;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view text = *entry;
        const std::string_view name = text.substr(0, text.find('='));
        if (std::ranges::none_of(command.environment, [&](const auto& own) { return own.first == name; })) merged.emplace_back(text);
    }
    for (const auto& [name, value] : command.environment)
        merged.push_back(fmt::format("{}={}", name, value));
    return merged;
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
    std::vector<char*> list;
    list.reserve(strings.size() + 1);
    for (std::string& text : strings)
        list.push_back(text.data());
    list.push_back(nullptr);
    return list;
}

struct Started {
    pid_t id;
    int output;
};

/// In the child, between fork and exec, where only async-signal-safe calls are allowed.
[[noreturn]] void becomeProgram(const char* program, char** arguments, char** environment, int output, pid_t parent) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL); // no orphan keeps a display or a Wine server alive when we are killed
    if (getppid() != parent) _exit(126);
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    execve(program, arguments, environment);
    _exit(127);
}

Error cannotStart(const std::string& name, const std::string& why) {
    return machineError(5003, fmt::format("cannot start {}: {}", name, why));
}

Result<Started> spawn(const ProcessCommand& command) {
    const std::string& name = command.arguments.at(0);
    const auto program = findProgram(name);
    if (!program) return cannotStart(name, "there is no such program");
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return cannotStart(name, std::strerror(errno));

    std::vector<std::string> arguments = command.arguments;
    std::vector<std::string> environment = mergedEnvironment(command);
    const std::vector<char*> argumentPointers = pointers(arguments);
    const std::vector<char*> environmentPointers = pointers(environment);
    const pid_t parent = getpid();
    const pid_t id = fork();
    if (id == 0)
        becomeProgram(program->c_str(), const_cast<char**>(argumentPointers.data()), const_cast<char**>(environmentPointers.data()),
                      ends[1], parent);
    const int error = errno;
    close(ends[1]);
    if (id < 0) {
        close(ends[0]);
        return cannotStart(name, std::strerror(error));
    }
    setpgid(id, id); // the child does the same; whoever is first, the group exists before anyone signals it
    return Started{id, ends[0]};
}

/// Appends what is there within the time. False at the end of the stream.
bool readSome(int file, int milliseconds, std::string& into) {
    pollfd waiting{.fd = file, .events = POLLIN, .revents = 0};
    if (poll(&waiting, 1, milliseconds) <= 0) return true;
    std::array<char, 4096> bytes{};
    const ssize_t count = read(file, bytes.data(), bytes.size());
    if (count > 0) into.append(bytes.data(), static_cast<std::size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
}

int exitCode(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

} // namespace

std::optional<fs::path> findProgram(const std::string& name) {
    const auto executable = [](const fs::path& path) {
        std::error_code code;
        return fs::is_regular_file(path, code) && access(path.c_str(), X_OK) == 0;
    };
    if (name.find('/') != std::string::npos) return executable(name) ? std::optional(fs::path(name)) : std::nullopt;
    const char* path = std::getenv("PATH");
    std::string_view folders = path == nullptr ? "" : path;
    while (!folders.empty()) {
        const std::size_t end = std::min(folders.find(':'), folders.size());
        if (const fs::path candidate = fs::path(folders.substr(0, end)) / name; executable(candidate)) return candidate;
        folders.remove_prefix(std::min(end + 1, folders.size()));
    }
    return {};
}

Result<ProcessResult> runProcess(const ProcessCommand& command, double timeoutSeconds) {
    const auto started = spawn(command);
    if (!started) return started.error();
    const auto end = after(timeoutSeconds);
    ProcessResult result;
    int status = 0;
    bool open = true;
    // The program's own end counts, not the end of its output: what it leaves behind (Wine's server) may hold the pipe open.
    while (waitpid(started->id, &status, WNOHANG) == 0) {
        if (Clock::now() >= end) {
            result.timedOut = true;
            kill(-started->id, SIGKILL);
            waitpid(started->id, &status, 0);
            break;
        }
        constexpr int kTick = 5;
        if (open)
            open = readSome(started->output, kTick, result.output);
        else
            std::this_thread::sleep_for(std::chrono::milliseconds(kTick));
    }
    for (std::size_t before = 0; open && (open = readSome(started->output, 0, result.output), result.output.size() != before);)
        before = result.output.size();
    close(started->output);
    result.exitCode = exitCode(status);
    return result;
}

Result<BackgroundProcess> BackgroundProcess::start(const ProcessCommand& command) {
    const auto started = spawn(command);
    if (!started) return started.error();
    return BackgroundProcess(started->id, started->output);
}

BackgroundProcess::BackgroundProcess(BackgroundProcess&& other) noexcept
    : id_(std::exchange(other.id_, -1)), output_(std::exchange(other.output_, -1)), pending_(std::move(other.pending_)) {}

BackgroundProcess& BackgroundProcess::operator=(BackgroundProcess&& other) noexcept {
    if (this != &other) {
        stop();
        id_ = std::exchange(other.id_, -1);
        output_ = std::exchange(other.output_, -1);
        pending_ = std::move(other.pending_);
    }
    return *this;
}

BackgroundProcess::~BackgroundProcess() {
    stop();
}

std::optional<std::string> BackgroundProcess::readLine(double timeoutSeconds) {
    const auto end = after(timeoutSeconds);
    while (pending_.find('\n') == std::string::npos && Clock::now() < end)
        if (!readSome(output_, millisecondsUntil(end), pending_)) break;
    const std::size_t length = pending_.find('\n');
    if (length == std::string::npos) return {};
    std::string line = pending_.substr(0, length);
    pending_.erase(0, length + 1);
    return line;
}

bool BackgroundProcess::running() {
    return id_ > 0 && waitpid(id_, nullptr, WNOHANG) == 0;
}

void BackgroundProcess::stop() {
    if (output_ >= 0) close(output_);
    if (id_ > 0) {
        kill(-id_, SIGTERM);
        const auto end = after(2);
        while (waitpid(id_, nullptr, WNOHANG) == 0 && Clock::now() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        if (kill(-id_, SIGKILL) == 0) waitpid(id_, nullptr, 0);
    }
    id_ = -1;
    output_ = -1;
}

} // namespace tegument
