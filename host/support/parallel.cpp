#include "host/support/parallel.h"

#include "host/support/threads.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>

namespace tegument {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kBetweenReports = std::chrono::milliseconds(200);

/// What the caller wrote before a loop is there for every thread that works on it. oneTBB sees to that, but ThreadSanitizer does not see
/// into oneTBB; an atomic of the loop's own would not do, for making it is a plain write.
std::atomic<std::size_t> handedOver = 0;

ParallelProgress& loopWatcher() {
    static ParallelProgress watcher;
    return watcher;
}

/// Of this thread: it is at work on an item.
thread_local bool inItem = false;

struct InItem {
    bool before = std::exchange(inItem, true);
    ~InItem() { inItem = before; }
};

class Loop {
public:
    Loop(std::size_t count, const std::function<Result<void>(std::size_t)>& body, const ParallelProgress& progress)
        : count_(count), body_(body), progress_(progress), watched_(loopWatcher() && !inItem), failed_(count) {}

    /// On so many threads, until there is no item any more, or none before the one that failed.
    Result<void> on(std::size_t threads) {
        handedOver.fetch_add(1, std::memory_order_release);
        onThreads(
            threads, [](void* loop) { static_cast<Loop*>(loop)->work(); }, this);
        return result();
    }

private:
    void work() {
        static_cast<void>(handedOver.load(std::memory_order_acquire));
        for (std::size_t item = next_++; item < failed_.load(); item = next_++)
            run(item);
        ended_.fetch_add(1, std::memory_order_release);
    }

    Result<void> result() {
        static_cast<void>(ended_.load(std::memory_order_acquire));
        if (exception_) std::rethrow_exception(exception_);
        if (error_) return std::move(*error_);
        if (progress_ && count_ > 0) progress_(count_, count_);
        if (watched_ && told_ > 0) loopWatcher()(count_, count_);
        return {};
    }

    void run(std::size_t item) {
        const InItem within;
        try {
            if (auto done = body_(item); !done) return fail(item, done.error(), nullptr);
            report();
        } catch (...) {
            fail(item, std::nullopt, std::current_exception());
        }
    }

    /// The lowest item wins, so that the caller gets the same error on every machine: items before it have all been begun.
    void fail(std::size_t item, std::optional<Error> error, std::exception_ptr exception) {
        const std::scoped_lock lock(failure_);
        if (item >= failed_.load()) return;
        failed_.store(item);
        error_ = std::move(error);
        exception_ = std::move(exception);
    }

    /// Whoever finds another thread reporting goes on instead of waiting.
    void report() {
        const std::size_t done = ++done_;
        if ((!progress_ && !watched_) || done == count_ || reporting_.test_and_set(std::memory_order_acquire)) return;
        const FlagHolder holder{reporting_};
        if (done <= told_ || Clock::now() - last_ < kBetweenReports) return;
        tell(done);
        told_ = done;
        last_ = Clock::now();
    }

    void tell(std::size_t done) const {
        if (progress_) progress_(done, count_);
        if (watched_) loopWatcher()(done, count_);
    }

    struct FlagHolder {
        std::atomic_flag& flag;
        ~FlagHolder() { flag.clear(std::memory_order_release); }
    };

    std::size_t count_;
    const std::function<Result<void>(std::size_t)>& body_;
    const ParallelProgress& progress_;
    bool watched_;
    std::atomic<std::size_t> next_ = 0;
    std::atomic<std::size_t> failed_; // the lowest item that failed; none: their number
    std::atomic<std::size_t> done_ = 0;
    std::atomic<std::size_t> ended_ = 0;
    std::mutex failure_; // guards the next two
    std::optional<Error> error_;
    std::exception_ptr exception_;
    std::atomic_flag reporting_; // guards the next two
    std::size_t told_ = 0;
    Clock::time_point last_ = Clock::now();
};

} // namespace

void watchLoops(ParallelProgress watcher) {
    loopWatcher() = std::move(watcher);
}

Result<void> tryEachInParallel(std::size_t count, const std::function<Result<void>(std::size_t)>& body, const ParallelProgress& progress,
                               unsigned threads) {
    return Loop(count, body, progress).on(std::min<std::size_t>(count, threads > 0 ? threads : availableThreads()));
}

void forEachInParallel(std::size_t count, const std::function<void(std::size_t)>& body, const ParallelProgress& progress,
                       unsigned threads) {
    const auto one = [&](std::size_t item) -> Result<void> {
        body(item);
        return {};
    };
    static_cast<void>(tryEachInParallel(count, one, progress, threads)); // its items report no errors, and exceptions go through
}

std::size_t chunkCount(std::size_t count) {
    constexpr std::size_t kWorthAThread = 512;
    constexpr std::size_t kMostChunks = 256; // a few for each thread of a large machine, so that none is idle at the end
    return std::min((count + kWorthAThread - 1) / kWorthAThread, kMostChunks);
}

void inChunks(std::size_t count, unsigned threads, const std::function<void(std::size_t, std::size_t, std::size_t)>& work) {
    const std::size_t chunks = chunkCount(count);
    forEachInParallel(
        chunks, [&](std::size_t chunk) { work(count * chunk / chunks, count * (chunk + 1) / chunks, chunk); }, {}, threads);
}

} // namespace tegument
