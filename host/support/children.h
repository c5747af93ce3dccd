#pragma once
// A function of ours run in processes of their own: what it brings down, or never ends, is one of them and not this program.

#include <functional>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

/// A variable of the environment of this process and of those that it starts, unless the user has set it. Before there are threads.
void setByDefault(const char* name, const char* value);

/// What became of a request.
struct ChildAnswer {
    bool answered = false;
    std::string bytes;     // where answered
    int signal = 0;        // that ended the process; 0: it left by itself, or there was none to ask
    bool timedOut = false; // it was ended
};

/// A process is a copy of this one (fork), made when a request finds none idle, kept for the next one, and ended with this program. Any
/// number of threads may ask at once.
class Children {
public:
    using Work = std::function<std::string(std::string_view request)>;

    /// `busy`: held (shared) by whoever runs code that the work needs too; a copy made in its midst would wait for its locks for ever.
    Children(Work work, std::shared_mutex& busy) : work_(std::move(work)), busy_(busy) {}
    ~Children();
    Children(const Children&) = delete;
    Children& operator=(const Children&) = delete;

    /// Makes so many at once: before the caller has threads, so that no copy is made while one of them holds a lock of some library.
    void prepare(std::size_t count);
    [[nodiscard]] ChildAnswer ask(std::string_view request, double seconds);

private:
    struct Child {
        int process = -1;
        int socket = -1;
        int lifeline = -1; // open while we are
    };

    [[nodiscard]] Child take();
    [[nodiscard]] Child start();
    [[noreturn]] void serve(int socket) const;
    void giveBack(Child child);
    int end(Child child);

    Work work_;
    std::shared_mutex& busy_;
    std::mutex mutex_;
    std::vector<Child> idle_;
    std::vector<int> sockets_; // of all: a new process must not hold them open
};

} // namespace tegument
