#pragma once
// The threads behind parallel.h, which is what to include. oneTBB's, shared with Embree's: together never more than the machine has.

#include <cstddef>

namespace tegument {

/// How many threads the program may use: the machine's, unless tbb::global_control says otherwise. At least 1.
[[nodiscard]] unsigned availableThreads();

/// Calls work(what) so many times, at once as far as threads are free, and waits for all calls. The calling thread takes part; a thread
/// that waits inside `work` for a loop of its own takes no call of this one meanwhile. `work` throws nothing.
void onThreads(std::size_t times, void (*work)(void* what), void* what);

} // namespace tegument
