#pragma once
// Work on many items by all processors. What comes out must not depend on how many there are.

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

namespace tegument {

/// 0: as many as the machine has.
[[nodiscard]] inline std::size_t threadCount(unsigned wanted) {
    return std::max(1U, wanted > 0 ? wanted : std::thread::hardware_concurrency());
}

/// Calls work(first, last, chunk) for chunks of [0, count), at once; chunk counts from 0, below threadCount(threads).
template <class Work>
void inChunks(std::size_t count, unsigned threads, Work work) {
    constexpr std::size_t kWorthAThread = 512;
    const std::size_t chunks = std::clamp<std::size_t>(count / kWorthAThread, 1, threadCount(threads));
    std::vector<std::thread> others;
    for (std::size_t i = 1; i < chunks; ++i)
        others.emplace_back([&work, count, chunks, i] { work(count * i / chunks, count * (i + 1) / chunks, i); });
    work(std::size_t{0}, count / chunks, std::size_t{0});
    for (std::thread& other : others)
        other.join();
}

} // namespace tegument
