#include "host/support/memory_limit.h"

#include "host/support/file.h"
#include "host/support/sanitized.h"

#include <algorithm>
#include <charconv>

#include <sys/resource.h>
#include <unistd.h>

namespace tegument {

static_assert(kNoMemoryLimit == RLIM_INFINITY);

/// Where a container says what it has: control groups of version 2 and 1.
static constexpr const char* kContainers[] = {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"};

std::uint64_t memoryOfTheMachine() {
    std::uint64_t bytes = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    for (const char* file : kContainers) {
        const auto text = readFile(file);
        std::uint64_t limit = 0;
        if (text && std::from_chars(text->data(), text->data() + text->size(), limit).ec == std::errc() && limit > 0)
            bytes = std::min(bytes, limit);
    }
    return bytes;
}

/// The limit that the caller gave (`ulimit -d`, `tegument batch --max-memory`) is not widened.
void limitMemoryTo(std::uint64_t bytes) {
    rlimit limit{};
    if (!kMemoryCanBeLimited || ::getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur <= bytes) return;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_DATA, &limit);
}

} // namespace tegument
