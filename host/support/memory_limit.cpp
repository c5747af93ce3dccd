#include "host/support/memory_limit.h"

#include "host/support/file.h"
#include "host/support/sanitized.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

namespace tegument {

static_assert(kNoMemoryLimit == RLIM_INFINITY);

/// Where a container says what it has: control groups of version 2 and 1.
static constexpr const char* kContainers[] = {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"};

namespace {

/// `MemAvailable:   12345 kB`; nothing where the system does not say it.
std::optional<std::uint64_t> bytesOf(std::string_view name, std::string_view text) {
    const std::size_t line = text.find(name);
    if (line == std::string_view::npos) return std::nullopt;
    text.remove_prefix(line + name.size());
    text.remove_prefix(std::min(text.find_first_not_of(" :"), text.size()));
    std::uint64_t kibibytes = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), kibibytes).ec != std::errc()) return std::nullopt;
    return kibibytes * 1024;
}

} // namespace

std::uint64_t memoryToBeHad() {
    std::uint64_t bytes = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    for (const char* file : kContainers) {
        const auto text = readFile(file);
        std::uint64_t limit = 0;
        if (text && std::from_chars(text->data(), text->data() + text->size(), limit).ec == std::errc() && limit > 0)
            bytes = std::min(bytes, limit);
    }
    constexpr std::uint64_t kLeast = 1ULL << 30U; // what a busy machine finds by writing out what it keeps of files
    const auto now = readFile("/proc/meminfo");
    if (const auto left = now ? bytesOf("MemAvailable", *now) : std::nullopt)
        bytes = std::min(bytes, std::max(kLeast, *left + bytesOf("SwapFree", *now).value_or(0)));
    return bytes;
}

void limitMemoryTo(std::uint64_t bytes) {
    static const auto kCallers = [] { // `ulimit -d`, `tegument batch --max-memory`
        rlimit limit{};
        return ::getrlimit(RLIMIT_DATA, &limit) == 0 ? std::optional(limit) : std::nullopt;
    }();
    if (!kMemoryCanBeLimited || !kCallers) return;
    const rlimit limit{.rlim_cur = std::min<rlim_t>(kCallers->rlim_cur, bytes), .rlim_max = kCallers->rlim_max};
    ::setrlimit(RLIMIT_DATA, &limit);
}

} // namespace tegument
