#include "host/reference/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

namespace tegument::reference {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kBetweenReports = std::chrono::milliseconds(200);

class Reporter {
public:
    Reporter(std::size_t total, const std::function<void(std::size_t, std::size_t)>& progress) : total_(total), progress_(progress) {}

    void oneDone() {
        if (!progress_) return;
        const std::scoped_lock lock(mutex_);
        ++done_;
        if (done_ < total_ && Clock::now() - last_ < kBetweenReports) return;
        last_ = Clock::now();
        progress_(done_, total_);
    }

private:
    std::size_t total_;
    const std::function<void(std::size_t, std::size_t)>& progress_;
    std::mutex mutex_;
    std::size_t done_ = 0;
    Clock::time_point last_ = Clock::now();
};

} // namespace

void forEachInParallel(std::size_t count, const std::function<void(std::size_t)>& body,
                       const std::function<void(std::size_t, std::size_t)>& progress) {
    Reporter reporter(count, progress);
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t item = next++; item < count; item = next++) {
            body(item);
            reporter.oneDone();
        }
    };
    const std::size_t threads = std::min<std::size_t>(count, std::max(1U, std::thread::hardware_concurrency()));
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < threads; ++i)
        others.emplace_back(work);
    work();
}

} // namespace tegument::reference
