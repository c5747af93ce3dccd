#include "host/support/threads.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace tegument {

unsigned availableThreads() {
    return static_cast<unsigned>(std::max<std::size_t>(1, tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)));
}

void onThreads(std::size_t times, void (*work)(void*), void* what) {
    if (times == 0) return;
    const auto one = [=] { work(what); };
    const auto all = [&] {
        // Isolated twice: while the caller waits here, and while a call waits for a loop of its own, Embree's included.
        const auto isolated = [&](std::size_t) { tbb::this_task_arena::isolate(one); };
        tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, times, isolated, tbb::simple_partitioner()); });
    };
    const int wanted = static_cast<int>(std::min<std::size_t>(times, availableThreads()));
    if (wanted <= tbb::this_task_arena::max_concurrency()) return all();
    tbb::task_arena arena(wanted); // the default one has as many places as the machine has processors
    arena.execute(all);
}

} // namespace tegument
