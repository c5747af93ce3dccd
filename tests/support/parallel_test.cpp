// Loops on all processors: every item once, errors and exceptions to the caller, the same on every machine, one loop inside another.

#include "host/support/file.h"
#include "host/support/memory_limit.h"
#include "host/support/parallel.h"
#include "host/support/sanitized.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tegument::test {
namespace {

constexpr unsigned kThreads = 8; // more than the machine may have: what goes wrong between threads is to show on any

class Parallel : public testing::Test {
    tbb::global_control allowed_{tbb::global_control::max_allowed_parallelism, kThreads};
};

/// Long enough for other threads to come in between.
void wait() {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST_F(Parallel, does_every_item_once_and_says_when_all_are_done) {
    std::vector<std::atomic<int>> calls(1000);
    std::size_t last = 0;
    forEachInParallel(
        calls.size(), [&](std::size_t i) { ++calls[i]; }, [&](std::size_t done, std::size_t) { last = std::max(last, done); });
    for (const auto& count : calls)
        EXPECT_EQ(count, 1);
    EXPECT_EQ(last, calls.size());
}

TEST_F(Parallel, a_watcher_hears_of_long_loops_and_of_none_inside_another) {
    std::vector<std::pair<std::size_t, std::size_t>> heard;
    watchLoops([&](std::size_t done, std::size_t total) { heard.emplace_back(done, total); });
    const auto sleep = [](std::size_t) { std::this_thread::sleep_for(std::chrono::milliseconds(60)); };
    forEachInParallel(3, [](std::size_t) { wait(); }); // over before anybody could read of it
    forEachInParallel(
        8, [&](std::size_t) { forEachInParallel(11, sleep, {}, 1); }, {}, 2);
    watchLoops({});
    forEachInParallel(13, sleep, {}, 1);
    ASSERT_FALSE(heard.empty());
    for (const auto& [done, total] : heard)
        EXPECT_EQ(total, 8U);
    EXPECT_EQ(heard.back().first, 8U);
}

TEST_F(Parallel, works_on_as_many_threads_as_are_allowed) {
    std::atomic<unsigned> inside = 0;
    forEachInParallel(kThreads, [&](std::size_t) {
        ++inside; // each item waits for all others
        for (int i = 0; i < 10'000 && inside < kThreads; ++i)
            wait();
        EXPECT_EQ(inside, kThreads);
    });
}

TEST_F(Parallel, on_one_thread_it_is_the_caller_s_and_items_come_in_order) {
    std::vector<std::size_t> items;
    forEachInParallel(
        100,
        [&, caller = std::this_thread::get_id()](std::size_t i) {
            EXPECT_EQ(std::this_thread::get_id(), caller);
            items.push_back(i);
        },
        {}, 1);
    std::vector<std::size_t> expected(100);
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(items, expected);
}

TEST_F(Parallel, no_more_threads_work_than_are_wanted) {
    std::atomic<int> now = 0;
    std::atomic<int> most = 0;
    const auto body = [&](std::size_t) {
        const int working = ++now;
        for (int known = most; working > known && !most.compare_exchange_weak(known, working);) {
        }
        wait();
        --now;
    };
    forEachInParallel(100, body, {}, 3);
    EXPECT_GT(most, 1);
    EXPECT_LE(most, 3);
}

TEST_F(Parallel, nothing_to_do_is_done) {
    bool called = false;
    forEachInParallel(
        0, [&](std::size_t) { called = true; }, [&](std::size_t, std::size_t) { called = true; });
    inChunks(0, 0, [&](std::size_t, std::size_t, std::size_t) { called = true; });
    EXPECT_FALSE(called);
    EXPECT_EQ(chunkCount(0), 0U);
}

TEST_F(Parallel, an_exception_comes_to_the_caller) {
    for (int i = 0; i < 20; ++i) {
        try {
            forEachInParallel(100, [](std::size_t item) {
                wait();
                if (item % 10 == 7) throw std::runtime_error("item " + std::to_string(item));
            });
            FAIL() << "no exception";
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "item 7") << "the lowest of those that throw, on any number of threads";
        }
    }
}

TEST_F(Parallel, an_error_comes_to_the_caller) {
    for (int i = 0; i < 20; ++i) {
        std::atomic<bool> begun = false;
        const auto result = tryEachInParallel(kThreads, [&, i](std::size_t item) -> Result<void> {
            if (item == 5) begun = true;
            for (int j = 0; item == 2 && j < 1000 && !begun; ++j)
                wait();
            if (item == (i % 2 == 0 ? 2U : 5U)) // the lower of the two fails last, or first
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
            if (item == 2 || item == 5) return usageError(8001, "item " + std::to_string(item));
            return {};
        });
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().diagnostics.front().text, "item 2") << "the lowest of those that fail, on any number of threads";
    }
}

TEST_F(Parallel, items_before_the_one_that_failed_are_all_done_and_most_behind_are_not) {
    std::vector<std::atomic<int>> calls(10000);
    const auto result = tryEachInParallel(calls.size(), [&](std::size_t item) -> Result<void> {
        ++calls[item];
        if (item == 100) return usageError(8001, "item 100");
        if (item > 100) wait(); // else the other threads may end the loop before the one with item 100 goes on to fail
        return {};
    });
    EXPECT_FALSE(result);
    for (std::size_t i = 0; i <= 100; ++i)
        EXPECT_EQ(calls[i], 1) << i;
    EXPECT_EQ(calls.back(), 0) << "nothing is begun once an item has failed";
}

TEST_F(Parallel, an_exception_of_the_progress_comes_to_the_caller) {
    EXPECT_THROW(forEachInParallel(
                     10, [](std::size_t) {}, [](std::size_t, std::size_t) { throw std::runtime_error("closed"); }),
                 std::runtime_error);
}

TEST_F(Parallel, progress_is_heard_from_one_thread_at_a_time_and_only_grows) {
    std::atomic<int> inside = 0;
    std::vector<std::size_t> heard;
    forEachInParallel(
        400, [](std::size_t) { std::this_thread::sleep_for(std::chrono::milliseconds(10)); },
        [&](std::size_t done, std::size_t total) {
            EXPECT_EQ(++inside, 1);
            EXPECT_EQ(total, 400U);
            wait();
            heard.push_back(done);
            --inside;
        });
    EXPECT_GT(heard.size(), 1U) << "half a second at eight threads: twice at least";
    for (std::size_t i = 1; i < heard.size(); ++i)
        EXPECT_GT(heard[i], heard[i - 1]);
    EXPECT_EQ(heard.back(), 400U);
}

TEST_F(Parallel, a_loop_may_stand_in_an_item_of_another) {
    std::vector<std::size_t> sums(50);
    forEachInParallel(sums.size(), [&](std::size_t outer) {
        std::vector<std::size_t> squares(100);
        forEachInParallel(squares.size(), [&](std::size_t inner) { squares[inner] = outer * inner; });
        sums[outer] = std::accumulate(squares.begin(), squares.end(), std::size_t{0});
    });
    for (std::size_t i = 0; i < sums.size(); ++i)
        EXPECT_EQ(sums[i], i * 4950);
}

TEST_F(Parallel, a_loop_inside_takes_up_no_item_of_the_one_outside) {
    // Would a waiting thread begin another outer item, it would take the lock that it holds. More threads are wanted than there are, so
    // that some of the outer loop have not begun when the first ones wait.
    std::atomic<int> wrong = 0;
    const auto outer = [&](std::size_t item) {
        thread_local bool held = false;
        if (held) ++wrong;
        held = true;
        forEachInParallel(2 + item % 7, [&](std::size_t i) {
            for (std::size_t j = 0; j <= (item + i) % 4; ++j)
                wait();
        });
        held = false;
    };
    for (int i = 0; i < 40; ++i)
        forEachInParallel(24, outer, {}, 24);
    EXPECT_EQ(wrong, 0);
}

TEST_F(Parallel, an_exception_in_a_loop_inside_goes_through_both) {
    EXPECT_THROW(
        forEachInParallel(
            20, [](std::size_t) { forEachInParallel(20, [](std::size_t i) { i == 5 ? throw std::out_of_range("inside") : wait(); }); }),
        std::out_of_range);
}

TEST_F(Parallel, chunks_cover_all_items_in_order_whatever_the_number_of_threads) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{511}, std::size_t{513}, std::size_t{100'000}, std::size_t{1'000'003}}) {
        using Chunk = std::pair<std::size_t, std::size_t>;
        std::vector<Chunk> first;
        for (const unsigned threads : {1U, 2U, 5U, 0U}) {
            std::vector<Chunk> chunks(chunkCount(count));
            inChunks(count, threads, [&](std::size_t from, std::size_t to, std::size_t chunk) { chunks.at(chunk) = {from, to}; });
            std::size_t next = 0;
            for (const Chunk& chunk : chunks) {
                EXPECT_EQ(chunk.first, next);
                EXPECT_LT(chunk.first, chunk.second);
                next = chunk.second;
            }
            EXPECT_EQ(next, count);
            if (threads == 1)
                first = chunks;
            else
                EXPECT_EQ(chunks, first) << threads << " threads";
        }
    }
}

TEST_F(Parallel, an_exception_in_a_chunk_comes_to_the_caller) {
    EXPECT_THROW(inChunks(100'000, 0,
                          [](std::size_t, std::size_t, std::size_t chunk) {
                              if (chunk == 3) throw std::bad_alloc();
                          }),
                 std::bad_alloc);
}

constexpr std::uint64_t kGibibyte = 1ULL << 30U;

rlim_t limitNow() {
    rlimit limit{};
    ::getrlimit(RLIMIT_DATA, &limit);
    return limit.rlim_cur;
}

} // namespace

TEST(MemoryLimit, is_by_default_what_is_free_and_no_more_than_the_machine_has) {
    const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    const std::uint64_t all = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * page;
    EXPECT_LE(memoryToBeHad(), all);
    EXPECT_GE(memoryToBeHad(), std::min(all, kGibibyte) / 2) << "half: a container may have less than the machine";
    const auto said = readFile("/proc/meminfo");
    const std::size_t line = said ? said->find("MemAvailable:") : std::string::npos;
    if (line == std::string::npos) return;
    const std::uint64_t available = std::stoull(said->substr(line + 13)) * 1024;
    const std::uint64_t swap = std::stoull(said->substr(said->find("SwapFree:") + 9)) * 1024;
    constexpr std::uint64_t kMeanwhile = kGibibyte; // others take and give back while we ask
    EXPECT_LE(memoryToBeHad(), std::max(kGibibyte, available + swap) + kMeanwhile);
}

TEST(MemoryLimit, of_ours_may_be_made_wider_and_the_callers_not) {
    if (!kMemoryCanBeLimited) return;
    const rlim_t callers = limitNow();
    limitMemoryTo(8 * kGibibyte);
    EXPECT_EQ(limitNow(), std::min<rlim_t>(callers, 8 * kGibibyte));
    limitMemoryTo(16 * kGibibyte);
    EXPECT_EQ(limitNow(), std::min<rlim_t>(callers, 16 * kGibibyte)) << "--max-memory may be more than the default";
    limitMemoryTo(kNoMemoryLimit);
    EXPECT_EQ(limitNow(), callers);
}

} // namespace tegument::test
