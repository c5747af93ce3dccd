#pragma once
// What became of one input: a file of its own, whole or not there.

#include "host/support/result.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tegument::batch {

struct Record {
    std::string input;
    std::vector<std::string> command; // as it ran, behind the program's name
    std::string identity;             // of identityOf
    int exitCode = 0;                 // 128 + n when signal n ended it
    bool outOfTime = false;
    double seconds = 0; // by the clock
    double processorSeconds = 0;
    std::size_t peakBytes = 0;
    std::string result;   // what it printed: JSON as it came, of anything else the last 4 KiB
    std::string messages; // the last 4 KiB of what it said on standard error
    std::string host;     // whose machine it was
    std::string ended;    // when, in UTC: 2026-11-22T18:30:00Z
};

/// "done", "out of time", "killed by signal 9", "failed (1)": the number is the exit code.
[[nodiscard]] std::string stateOf(const Record& record);
[[nodiscard]] bool isDone(const Record& record);

/// The record's file in a folder of records. It depends on input and command, so that a new run replaces the old.
[[nodiscard]] std::filesystem::path recordFile(const std::filesystem::path& folder, const std::string& input,
                                               const std::vector<std::string>& command);

/// One line of JSON. TG5002.
[[nodiscard]] Result<void> writeRecord(const std::filesystem::path& folder, const Record& record);
[[nodiscard]] std::string lineOf(const Record& record);

/// TG5001; TG8105 it is not a record.
[[nodiscard]] Result<Record> readRecord(const std::filesystem::path& file);

/// All of these folders, sorted by input and command. Of one input and command in two folders the later one. TG8106 a folder that holds
/// none; TG8105.
[[nodiscard]] Result<std::vector<Record>> readRecords(const std::vector<std::filesystem::path>& folders);

/// Values of what the command printed as JSON, by JSON pointers such as /faces: "" where there is no such value.
[[nodiscard]] std::string valueAt(const Record& record, const std::string& pointer);

} // namespace tegument::batch
