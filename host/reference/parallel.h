#pragma once
// Work that falls into independent items, on all cores.

#include <cstddef>
#include <functional>

namespace tegument::reference {

/// Calls body(i) for i = 0 .. count - 1, each once, in any order, from as many threads as there are cores. `progress`, if any, hears now
/// and then how many are done and, at the end, that all are; never from two threads at once.
void forEachInParallel(std::size_t count, const std::function<void(std::size_t item)>& body,
                       const std::function<void(std::size_t done, std::size_t total)>& progress = {});

} // namespace tegument::reference
