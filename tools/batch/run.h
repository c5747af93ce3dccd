#pragma once
// Runs what is not done yet.

#include "tools/batch/command.h"
#include "tools/batch/record.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tegument::batch {

struct Batch {
    std::string program;                     // file of the program whose command it is
    std::string programIdentity;             // of thisProgram
    std::vector<std::string> words;          // of the command, with places to fill
    std::vector<std::filesystem::path> with; // more files that decide the outcome
    FilesBehind filesBehind;
    std::filesystem::path results;
    double timeLimit = 3600;  // seconds for each input
    std::size_t maxBytes = 0; // of memory for each input; 0: no limit
    unsigned jobs = 1;        // inputs at a time
    bool keepsFailed = false; // what failed before, with nothing changed since, is not tried again
};

struct Sums {
    std::size_t done = 0;
    std::size_t kept = 0; // were done before
    std::size_t failed = 0;
    int worst = 0; // exit code among those that failed
};

/// Hears of each input, from one thread at a time.
using Heard = std::function<void(const Record& record, bool kept)>;

/// Runs the command for each input that has no record of the same identity, or has failed, and writes its record when it has ended: one
/// that is stopped leaves none, and the next run does it. An input that fails, crashes, takes too long or too much memory fails alone.
/// An error is the batch's own: TG5002 a record cannot be written, TG5003 the program cannot be started.
[[nodiscard]] Result<Sums> runBatch(const std::vector<std::string>& inputs, const Batch& batch, const Heard& heard);

/// An input that the batch would run.
struct Pending {
    std::string input;
    std::filesystem::path record; // where its record will be
    std::string identity;
};

[[nodiscard]] std::vector<Pending> pendingOf(const std::vector<std::string>& inputs, const Batch& batch);

/// Those that have no record of their identity yet, good or bad: to look how far others are.
[[nodiscard]] std::vector<Pending> stillPending(const std::vector<Pending>& pending);

} // namespace tegument::batch
