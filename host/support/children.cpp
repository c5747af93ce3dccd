#include "host/support/children.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tegument {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kLongest = std::uint64_t{1} << 30; // bytes of a message: more is none of ours

/// Whether there is something to read, or an end, before the deadline.
bool readable(int socket, Clock::time_point deadline) {
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        pollfd waiting{.fd = socket, .events = POLLIN, .revents = 0};
        const int ready = poll(&waiting, 1, static_cast<int>(std::clamp<long>(left, 0, 1'000'000)));
        if (ready > 0) return true;
        if (ready == 0 || errno != EINTR) return false;
    }
}

/// What a worker held of its process's files, pipes and sockets would stay open as long as the worker lives.
void closeAllBut(int one, int other) {
    unsigned from = STDERR_FILENO + 1;
    for (const int kept : {std::min(one, other), std::max(one, other)}) {
        if (kept < static_cast<int>(from)) continue;
        if (static_cast<unsigned>(kept) > from) close_range(from, static_cast<unsigned>(kept) - 1, 0);
        from = static_cast<unsigned>(kept) + 1;
    }
    close_range(from, ~0U, 0);
}

bool sendAll(int socket, const char* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t sent = send(socket, bytes, count, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        bytes += sent;
        count -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool sendMessage(int socket, std::string_view message) {
    const std::uint64_t size = message.size();
    return sendAll(socket, reinterpret_cast<const char*>(&size), sizeof size) && sendAll(socket, message.data(), message.size());
}

enum class Received { All, Ended, Late };

Received receiveAll(int socket, char* bytes, std::size_t count, Clock::time_point deadline) {
    while (count > 0) {
        if (!readable(socket, deadline)) return Received::Late;
        const ssize_t got = recv(socket, bytes, count, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return Received::Ended;
        bytes += got;
        count -= static_cast<std::size_t>(got);
    }
    return Received::All;
}

Received receiveMessage(int socket, std::string& message, Clock::time_point deadline) {
    std::uint64_t size = 0;
    if (const Received head = receiveAll(socket, reinterpret_cast<char*>(&size), sizeof size, deadline); head != Received::All) return head;
    if (size > kLongest) return Received::Ended;
    message.resize(size);
    return receiveAll(socket, message.data(), message.size(), deadline);
}

/// Of the program's own: none of its handlers, no core file, nothing printed.
void becomeQuiet() {
    for (const int number : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGINT, SIGTERM, SIGHUP, SIGQUIT})
        std::signal(number, SIG_DFL);
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
}

/// Ends this process at once, whatever it does, when the pipe's other end is closed: that is when the program has ended.
void endWith(int lifeline) {
    std::signal(SIGIO, SIG_DFL);
    fcntl(lifeline, F_SETOWN, getpid());
    fcntl(lifeline, F_SETFL, fcntl(lifeline, F_GETFL) | O_ASYNC);
    pollfd asked{.fd = lifeline, .events = POLLIN, .revents = 0};
    if (poll(&asked, 1, 0) > 0) _exit(0); // it was faster
}

} // namespace

Children::~Children() {
    for (const Child child : idle_)
        end(child);
}

void Children::serve(int socket) const {
    becomeQuiet();
    std::string request;
    while (receiveMessage(socket, request, Clock::time_point::max() - std::chrono::hours(1)) == Received::All) {
        std::string answer;
        try {
            answer = work_(request);
        } catch (const std::exception&) {
            break;
        }
        if (!sendMessage(socket, answer)) break;
    }
    _exit(0); // destructors and buffers are the parent's
}

Children::Child Children::start() {
    const std::unique_lock alone(busy_);
    const std::unique_lock lock(mutex_); // until the child's end is closed here: a second child would hold it open
    int ends[2] = {-1, -1};
    int lifeline[2] = {-1, -1};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return {};
    if (pipe2(lifeline, O_CLOEXEC) != 0) lifeline[0] = lifeline[1] = -1;
    const pid_t process = fork();
    if (process == 0) {
        close(ends[0]);
        close(lifeline[1]);
        closeAllBut(ends[1], lifeline[0]);
        endWith(lifeline[0]);
        serve(ends[1]);
    }
    close(ends[1]);
    close(lifeline[0]);
    if (process < 0) {
        close(ends[0]);
        close(lifeline[1]);
        return {};
    }
    sockets_.push_back(ends[0]);
    sockets_.push_back(lifeline[1]);
    return {process, ends[0], lifeline[1]};
}

void Children::prepare(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        if (const Child child = start(); child.process >= 0) giveBack(child);
}

Children::Child Children::take() {
    {
        const std::unique_lock lock(mutex_);
        if (!idle_.empty()) {
            const Child child = idle_.back();
            idle_.pop_back();
            return child;
        }
    }
    return start();
}

void Children::giveBack(Child child) {
    const std::unique_lock lock(mutex_);
    idle_.push_back(child);
}

/// The signal that ended it; 0: none.
int Children::end(Child child) {
    {
        const std::unique_lock lock(mutex_);
        std::erase(sockets_, child.socket);
        std::erase(sockets_, child.lifeline);
    }
    close(child.socket);
    int status = 0;
    while (waitpid(child.process, &status, 0) < 0)
        if (errno != EINTR) break;
    close(child.lifeline);
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

ChildAnswer Children::ask(std::string_view request, double seconds) {
    const Child child = take();
    ChildAnswer answer;
    if (child.process < 0) return answer;
    const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    const Received received = sendMessage(child.socket, request) ? receiveMessage(child.socket, answer.bytes, deadline) : Received::Ended;
    answer.answered = received == Received::All;
    if (answer.answered) {
        giveBack(child);
        return answer;
    }
    answer.timedOut = received == Received::Late;
    if (answer.timedOut) kill(child.process, SIGKILL);
    answer.signal = end(child);
    return answer;
}

void setByDefault(const char* name, const char* value) {
    ::setenv(name, value, 0);
}

} // namespace tegument
