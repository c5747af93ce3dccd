#pragma once
// Work that falls into independent items, on all processors. What comes out depends neither on how many processors there are nor on
// which of them is first, and what goes wrong in an item comes back to the caller: an error as a Result, an exception as itself.
//
// A loop may stand in an item of another one. While it waits it runs items of its own only, so that a lock held around it is safe.
// A program that wants fewer threads, or more, says so to oneTBB: tbb::global_control(max_allowed_parallelism, n).

#include "host/support/result.h"

#include <cstddef>
#include <functional>

namespace tegument {

/// Hears now and then how many items of all are done, never from two threads at once; at the end, unless something failed, that all are.
using ParallelProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Hears of every loop that takes longer than a moment and stands in no item of another one, as a progress of its own would: for a program
/// that shows how far it is. None: nobody hears. Not to be called while a loop runs.
void watchLoops(ParallelProgress watcher);

/// Calls body(i) for i = 0 .. count - 1, each once, begun in this order, from at most `threads` threads (0: as many as the machine has).
/// An exception of the body is thrown again here, when all threads have ended: that of the lowest item that throws. Items behind it may
/// be left out.
void forEachInParallel(std::size_t count, const std::function<void(std::size_t item)>& body, const ParallelProgress& progress = {},
                       unsigned threads = 0);

/// As forEachInParallel, for items that can fail: the error of the lowest item that fails.
[[nodiscard]] Result<void> tryEachInParallel(std::size_t count, const std::function<Result<void>(std::size_t item)>& body,
                                             const ParallelProgress& progress = {}, unsigned threads = 0);

/// Into how many chunks inChunks cuts so many items: 0 for none, at most 256. It does not depend on the machine.
[[nodiscard]] std::size_t chunkCount(std::size_t count);

/// Calls work(first, last, chunk) for the chunks of [0, count), in order the items of chunk 0, 1 .. chunkCount(count) - 1. For items that
/// are too cheap to be handed out one by one. Exceptions as with forEachInParallel.
void inChunks(std::size_t count, unsigned threads, const std::function<void(std::size_t first, std::size_t last, std::size_t chunk)>& work);

} // namespace tegument
