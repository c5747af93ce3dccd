#include "tools/cli/max_memory.h"

#include "host/support/memory_limit.h"

#include <CLI/CLI.hpp>

#include <cstdint>

namespace tegument::app {

namespace {

constexpr std::uint64_t kMebibyte = 1024ULL * 1024;
constexpr std::uint64_t kMostMebibytes = kNoMemoryLimit / kMebibyte;

void addTo(CLI::App& command) {
    const auto below = command.get_subcommands([](CLI::App*) { return true; });
    for (CLI::App* each : below)
        addTo(*each);
    if (command.get_parent() == nullptr || command.get_option_no_throw("--max-memory") != nullptr) return;
    command
        .add_option_function<std::uint64_t>(
            "--max-memory", [](std::uint64_t given) { limitMemoryTo(given * kMebibyte); }, "MiB of memory; default: what is free")
        ->check(CLI::Range(std::uint64_t{1}, kMostMebibytes))
        ->type_name("MIB");
}

} // namespace

void limitMemory(CLI::App& program) {
    limitMemoryTo(memoryToBeHad());
    addTo(program);
}

} // namespace tegument::app
