#pragma once
// What `tegument batch` and `tegument submit` have in common.

#include "tools/batch/inputs.h"
#include "tools/batch/run.h"
#include "tools/cli/command_line.h"

#include <string>
#include <vector>

namespace tegument::app {

struct BatchOptions {
    std::vector<std::string> inputs; // files and patterns
    std::string list;
    std::string results;
    std::vector<std::string> with;
    double timeLimit = 3600; // s
    double maxMemory = 0;    // MiB
    unsigned jobs = 1;
    bool keepsFailed = false;
    std::vector<std::string> words; // the command
};

void addBatchOptions(CLI::App& command, BatchOptions& options);

/// The options as they were given, for a command line that does the same elsewhere; the inputs are those that `list` holds.
[[nodiscard]] std::vector<std::string> sameOptions(const BatchOptions& options, const std::string& list);

/// TG8107 `program` has no such command, or one that a batch cannot run; TG8103, TG8104, and whatever reading the program may bring.
[[nodiscard]] Result<batch::Batch> batchOf(const BatchOptions& options, const std::vector<std::string>& inputs, const CLI::App& program);

} // namespace tegument::app
