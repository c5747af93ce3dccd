#include "tools/cli/ends.h"

#include "host/support/sanitized.h"
#include "host/support/temporary.h"
#include "tools/cli/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace tegument::app {

namespace {

constexpr std::array kInterruptions = {SIGINT, SIGTERM, SIGHUP};

int interruptionPipe = -1; // a handler may write to it, and do little else

void interrupted(int signal) {
    const int before = errno;
    const auto number = static_cast<unsigned char>(signal);
    [[maybe_unused]] const auto written = ::write(interruptionPipe, &number, 1);
    errno = before;
}

void endBy(int signal) {
    removeTemporaries();
    say(fmt::format("tegument: interrupted ({}); every file that stands there is whole", strsignal(signal)));
    std::signal(signal, SIG_DFL);
    ::kill(::getpid(), signal);
}

void waitForInterruption(int pipe) {
    unsigned char signal = 0;
    while (::read(pipe, &signal, 1) < 0 && errno == EINTR) {
    }
    if (signal != 0) endBy(signal);
}

constexpr std::array kDeaths = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL};
constexpr int kMachine = 3;

/// What RLIMIT_DATA counts, in bytes. Allocates nothing and takes no lock: a signal handler calls it.
std::uint64_t dataInUse() {
    std::array<char, 256> text{};
    const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (file < 0 || ::read(file, text.data(), text.size() - 1) <= 0) return 0;
    const char* at = text.data();
    for (int field = 0; field < 5; ++field) // the sixth is the data
        while (*at != 0 && *at++ != ' ') {
        }
    std::uint64_t pages = 0;
    std::from_chars(at, text.data() + text.size(), pages);
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// Drivers, and libraries under them, do not check what they were given, and die where memory ends.
bool memoryIsShort(std::uint64_t used, std::uint64_t limit) {
    constexpr std::uint64_t kMuch = 256ULL << 20U;
    return limit != RLIM_INFINITY && used + std::max(limit / 4, kMuch) > limit;
}

/// One line, by what a handler may call. Where memory ends, exit code 3 as of any command that lacks some; else the signal ends the
/// program.
void died(int signal) {
    static std::atomic_flag first;
    while (first.test_and_set())
        ::pause(); // another thread is saying it
    rlimit limit{};
    const std::uint64_t used = dataInUse();
    const bool isShort = ::getrlimit(RLIMIT_DATA, &limit) == 0 && memoryIsShort(used, limit.rlim_cur);
    std::array<char, 256> line{};
    const auto end =
        isShort ? fmt::format_to_n(line.data(), line.size(),
                                   "tegument: error TG8001: out of memory: signal {} with {} of {} MiB in use; try a smaller size or map "
                                   "size, or a larger --max-memory\n",
                                   signal, used >> 20U, limit.rlim_cur >> 20U)
                : fmt::format_to_n(line.data(), line.size(),
                                   "tegument: error TG8002: unexpected failure: signal {} in the program or its driver; report it with "
                                   "the command line\n",
                                   signal);
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), std::min(end.size, line.size()));
    if (isShort) ::_exit(kMachine);
    std::signal(signal, SIG_DFL);
    ::raise(signal);
}

/// On a stack of its own: the main thread's may be what is full. Sanitizers have handlers of their own. A fault of the handler itself ends
/// the program: it would wait for itself.
void sayDeaths() {
    if (!kMemoryCanBeLimited) return;
    static std::array<char, 1U << 16U> own{};
    const stack_t stack{.ss_sp = own.data(), .ss_flags = 0, .ss_size = own.size()};
    ::sigaltstack(&stack, nullptr);
    struct sigaction action = {};
    action.sa_handler = died;
    action.sa_flags = SA_ONSTACK;
    for (const int signal : kDeaths)
        ::sigaddset(&action.sa_mask, signal);
    for (const int signal : kDeaths)
        ::sigaction(signal, &action, nullptr);
}

void openStandardStreams() {
    int file = ::open("/dev/null", O_RDWR);
    while (file >= 0 && file <= STDERR_FILENO) // the lowest number that is free
        file = ::dup(file);
    if (file > STDERR_FILENO) ::close(file);
}

/// What the caller ignores (`nohup`, a job in the background) stays ignored.
void listenTo(int signal) {
    struct sigaction action = {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) return;
    action = {};
    action.sa_handler = interrupted;
    action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
}

} // namespace

void begin() {
    openStandardStreams();
    std::signal(SIGXFSZ, SIG_IGN);
    sayDeaths();
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
    interruptionPipe = ends[1];
    try {
        std::thread(waitForInterruption, ends[0]).detach();
    } catch (const std::system_error&) {
        return; // no thread to be had: signals end the program at once, and whoever needs a thread says so
    }
    for (const int signal : kInterruptions)
        listenTo(signal);
}

} // namespace tegument::app
