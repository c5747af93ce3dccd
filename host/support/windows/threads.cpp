#include "host/support/threads.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace tegument {

namespace {

/// Threads beside the program's first one that no loop has taken.
std::atomic<int>& freeThreads() {
    static std::atomic<int> count = static_cast<int>(availableThreads()) - 1;
    return count;
}

/// As many as are free, at most so many: a loop in an item of another one finds few or none, and runs in its own thread.
int takeThreads(std::size_t most) {
    int left = freeThreads().load();
    int taken = 0;
    do
        taken = static_cast<int>(std::min<std::size_t>(most, static_cast<std::size_t>(std::max(left, 0))));
    while (!freeThreads().compare_exchange_weak(left, left - taken));
    return taken;
}

} // namespace

unsigned availableThreads() {
    return std::max(1U, std::thread::hardware_concurrency());
}

void onThreads(std::size_t times, void (*work)(void*), void* what) {
    if (times == 0) return;
    std::atomic<std::size_t> next = 0;
    const auto calls = [&] {
        while (next++ < times)
            work(what);
    };
    const int others = takeThreads(times - 1);
    {
        std::vector<std::jthread> threads;
        threads.reserve(static_cast<std::size_t>(others));
        for (int i = 0; i < others; ++i)
            threads.emplace_back(calls);
        calls();
    }
    freeThreads() += others;
}

} // namespace tegument
