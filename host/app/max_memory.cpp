#include "host/app/max_memory.h"

#include "host/support/file.h"
#include "host/support/sanitized.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>

#include <sys/resource.h>
#include <unistd.h>

namespace tegument::app {

namespace {

constexpr std::uint64_t kMebibyte = 1024ULL * 1024;
constexpr std::uint64_t kMostMebibytes = RLIM_INFINITY / kMebibyte;

/// Where a container says what it has: control groups of version 2 and 1.
constexpr const char* kContainers[] = {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"};

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
void limitTo(std::uint64_t bytes) {
    rlimit limit{};
    if (!kMemoryCanBeLimited || ::getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur <= bytes) return;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_DATA, &limit);
}

void addTo(CLI::App& command) {
    const auto below = command.get_subcommands([](CLI::App*) { return true; });
    for (CLI::App* each : below)
        addTo(*each);
    if (command.get_parent() == nullptr || command.get_option_no_throw("--max-memory") != nullptr) return;
    command
        .add_option_function<std::uint64_t>(
            "--max-memory", [](std::uint64_t given) { limitTo(given * kMebibyte); }, "MiB of memory; default: what the machine has")
        ->check(CLI::Range(std::uint64_t{1}, kMostMebibytes))
        ->type_name("MIB");
}

} // namespace

void limitMemory(CLI::App& program) {
    limitTo(memoryOfTheMachine());
    addTo(program);
}

} // namespace tegument::app
