#include "host/app/ends.h"

#include "host/app/output.h"
#include "host/support/temporary.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

#include <fcntl.h>
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
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
    interruptionPipe = ends[1];
    std::thread(waitForInterruption, ends[0]).detach();
    for (const int signal : kInterruptions)
        listenTo(signal);
}

} // namespace tegument::app
