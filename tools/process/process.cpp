#include "tools/process/process.h"

#include "tools/process/any_process.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
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
        if (!value.empty()) merged.push_back(fmt::format("{}={}", name, value));
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
    int errors; // -1: they are in the output
};

/// What a child becomes; it outlives the fork.
struct Program {
    const char* file;
    char** arguments;
    char** environment;
    int output;
    int errors;
    std::size_t maxBytes;
    sigset_t signals; // that the caller's thread blocks: the child inherits those of the thread that forks
};

/// In the child, between fork and exec, where only async-signal-safe calls are allowed.
[[noreturn]] void become(const Program& program, pid_t parent) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL); // no orphan keeps a display or a Wine server alive when we are killed
    if (getppid() != parent) _exit(126);
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    dup2(program.output, STDOUT_FILENO);
    dup2(program.errors, STDERR_FILENO);
    if (program.maxBytes > 0) {
        const rlimit limit{.rlim_cur = program.maxBytes, .rlim_max = program.maxBytes};
        setrlimit(RLIMIT_DATA, &limit); // what it may write, without what it only reserves or maps to read
    }
    sigprocmask(SIG_SETMASK, &program.signals, nullptr);
    execve(program.file, program.arguments, program.environment);
    _exit(127);
}

struct Forked {
    pid_t id;
    int error; // errno when there is no child
};

/// The system ends a child when the thread that forked it ends, not when the process does: one thread that never ends forks them all.
class Forker {
public:
    Forked fork(const Program& program) {
        const std::scoped_lock one(callers_);
        std::unique_lock lock(mutex_);
        program_ = &program;
        changed_.notify_all();
        changed_.wait(lock, [&] { return forked_.has_value(); });
        const Forked result = *forked_;
        forked_.reset();
        return result;
    }

    /// Never destroyed: its thread waits in it until the process ends. A copy of this process made by fork has no such thread, and gets
    /// one.
    static Forker& ofThisProcess() {
        static std::mutex mutex;
        static Forker* forker = nullptr;
        static pid_t owner = 0;
        const std::scoped_lock lock(mutex);
        if (owner != getpid()) forker = new Forker;
        owner = getpid();
        return *forker;
    }

private:
    Forker() {
        std::thread([this] { work(); }).detach();
    }

    [[noreturn]] void work() {
        sigset_t all;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, nullptr); // signals of the process belong to the program's own threads
        std::unique_lock lock(mutex_);
        for (;;) {
            changed_.wait(lock, [&] { return program_ != nullptr; });
            const pid_t parent = getpid();
            const pid_t id = ::fork();
            if (id == 0) become(*program_, parent);
            forked_ = Forked{id, errno};
            program_ = nullptr;
            changed_.notify_all();
        }
    }

    std::mutex callers_;
    std::mutex mutex_; // guards the rest
    std::condition_variable changed_;
    const Program* program_ = nullptr;
    std::optional<Forked> forked_;
};

Error cannotStart(const std::string& name, const std::string& why) {
    return machineError(5003, fmt::format("cannot start {}: {}", name, why));
}

Result<Started> spawn(const ProcessCommand& command) {
    const std::string& name = command.arguments.at(0);
    const auto program = findProgram(name);
    if (!program) return cannotStart(name, "there is no such program");
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return cannotStart(name, std::strerror(errno));
    std::array<int, 2> errors{-1, ends[1]};
    if (command.errorsApart && pipe2(errors.data(), O_CLOEXEC) != 0) {
        const std::string why = std::strerror(errno);
        close(ends[0]);
        close(ends[1]);
        return cannotStart(name, why);
    }

    std::vector<std::string> arguments = command.arguments;
    std::vector<std::string> environment = mergedEnvironment(command);
    const std::vector<char*> argumentPointers = pointers(arguments);
    const std::vector<char*> environmentPointers = pointers(environment);
    Program child{.file = program->c_str(),
                  .arguments = const_cast<char**>(argumentPointers.data()),
                  .environment = const_cast<char**>(environmentPointers.data()),
                  .output = ends[1],
                  .errors = errors[1],
                  .maxBytes = command.maxBytes};
    pthread_sigmask(SIG_SETMASK, nullptr, &child.signals);
    const auto [id, error] = Forker::ofThisProcess().fork(child);
    close(ends[1]);
    if (command.errorsApart) close(errors[1]);
    if (id < 0) {
        close(ends[0]);
        if (command.errorsApart) close(errors[0]);
        return cannotStart(name, std::strerror(error));
    }
    setpgid(id, id); // the child does the same; whoever is first, the group exists before anyone signals it
    return Started{id, ends[0], errors[0]};
}

enum class ChildState { Running, Ended, NotOurs };

/// Leaves a child that has ended to be waited for: until then nobody else gets its number, nor that of its group, and both may be
/// signalled. Not ours: someone else has waited for it, or the system does where SIGCHLD is ignored; its numbers may be anybody's.
ChildState stateOf(pid_t id) {
    siginfo_t info{};
    int failed = 0;
    do
        failed = waitid(P_PID, static_cast<id_t>(id), &info, WEXITED | WNOHANG | WNOWAIT);
    while (failed != 0 && errno == EINTR);
    if (failed != 0) return ChildState::NotOurs;
    return info.si_pid == 0 ? ChildState::Running : ChildState::Ended;
}

struct Ended {
    int status;
    rusage used;
};

/// Waits until it ends, and gives its number back to the system. Nothing if it was not ours any more.
std::optional<Ended> reap(pid_t id) {
    Ended ended{};
    pid_t done = 0;
    do
        done = wait4(id, &ended.status, 0, &ended.used);
    while (done < 0 && errno == EINTR);
    return done == id ? std::optional(ended) : std::nullopt;
}

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

constexpr std::size_t kLongestOutput = 64U << 20U; // what a program says beyond it is read and forgotten

/// Appends what is there within the time. False at the end of the stream.
bool readSome(int file, int milliseconds, std::string& into) {
    pollfd waiting{.fd = file, .events = POLLIN, .revents = 0};
    if (poll(&waiting, 1, milliseconds) <= 0) return true;
    std::array<char, 4096> bytes{};
    const ssize_t count = read(file, bytes.data(), bytes.size());
    if (count > 0 && into.size() < kLongestOutput) into.append(bytes.data(), static_cast<std::size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
}

/// One end of a pipe that fills a text. Closed with it.
struct Stream {
    Stream(int from, std::string& to) : file(from), text(to), open(from >= 0) {}
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
    ~Stream() {
        if (file >= 0) close(file);
    }
    void readRest() {
        for (std::size_t before = text.size(); open && (open = readSome(file, 0, text), text.size() != before);)
            before = text.size();
    }
    int file;
    std::string& text;
    bool open;
};

/// Reads from whichever has something within the time.
void readFrom(Stream& a, Stream& b, int milliseconds) {
    std::array<pollfd, 2> waiting{pollfd{.fd = a.open ? a.file : -1, .events = POLLIN, .revents = 0},
                                  pollfd{.fd = b.open ? b.file : -1, .events = POLLIN, .revents = 0}};
    if (poll(waiting.data(), waiting.size(), milliseconds) <= 0) return;
    if (waiting[0].revents != 0) a.open = readSome(a.file, 0, a.text);
    if (waiting[1].revents != 0) b.open = readSome(b.file, 0, b.text);
}

int exitCode(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

} // namespace

std::optional<fs::path> findProgram(const std::string& name) {
    const auto executable = [](const fs::path& path) {
        std::error_code code;
        return fs::is_regular_file(path, code) && access(path.c_str(), X_OK) == 0 ? std::optional(path) : std::nullopt;
    };
    if (name.find('/') != std::string::npos) return executable(name);
    const char* path = std::getenv("PATH");
    return findInFolders(path == nullptr ? "" : path, ':', name, executable);
}

Result<ProcessResult> runProcess(const ProcessCommand& command, double timeoutSeconds) {
    const auto started = spawn(command);
    if (!started) return started.error();
    const auto end = after(timeoutSeconds);
    ProcessResult result;
    Stream output{started->output, result.output};
    Stream errors{started->errors, result.errors};
    // The program's own end counts, not the end of its output: what it leaves behind (Wine's server) may hold the pipe open.
    while (stateOf(started->id) == ChildState::Running) {
        if (Clock::now() >= end) {
            result.timedOut = true;
            kill(-started->id, SIGKILL);
            break;
        }
        constexpr int kTick = 5;
        if (output.open || errors.open)
            readFrom(output, errors, kTick);
        else
            std::this_thread::sleep_for(std::chrono::milliseconds(kTick));
    }
    output.readRest();
    errors.readRest();
    const auto ended = reap(started->id);
    if (!ended) return machineError(5003, fmt::format("how {} ended is not known: SIGCHLD is ignored here", command.arguments.at(0)));
    result.exitCode = exitCode(ended->status);
    result.processorSeconds = seconds(ended->used.ru_utime) + seconds(ended->used.ru_stime);
    result.peakBytes = static_cast<std::size_t>(ended->used.ru_maxrss) * 1024;
    return result;
}

Result<BackgroundProcess> BackgroundProcess::start(const ProcessCommand& command) {
    ProcessCommand joined = command;
    joined.errorsApart = false;
    const auto started = spawn(joined);
    if (!started) return started.error();
    return BackgroundProcess(started->id, started->output);
}

std::optional<std::string> BackgroundProcess::readLine(double timeoutSeconds) {
    const auto end = after(timeoutSeconds);
    while (pending_.find('\n') == std::string::npos && Clock::now() < end)
        if (!readSome(output_, millisecondsUntil(end), pending_)) break;
    return takeLine(pending_);
}

bool BackgroundProcess::running() {
    return id_ > 0 && stateOf(id_) == ChildState::Running;
}

void BackgroundProcess::stop() {
    if (output_ >= 0) close(output_);
    output_ = -1;
    const pid_t id = std::exchange(id_, -1);
    if (id <= 0 || stateOf(id) == ChildState::NotOurs) return;
    kill(-id, SIGTERM);
    const auto end = after(2);
    while (stateOf(id) == ChildState::Running && Clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (stateOf(id) == ChildState::NotOurs) return;
    kill(-id, SIGKILL); // what it started and left in its group, too
    reap(id);
}

} // namespace tegument
