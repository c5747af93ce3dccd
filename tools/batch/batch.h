#pragma once
// One command for many inputs, each in a process and with a record of its own.

#include "host/support/result.h"
#include "tools/report/report.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tegument::batch {

struct FileState {
    std::size_t bytes = 0;
    std::string hash; // empty: it changed while it was read
};
using FileStates = std::map<std::string, FileState>;

/// What became of one input: a file of its own, whole or not there.
struct Record {
    std::string input;
    std::vector<std::string> command; // as it ran, behind the program's name
    std::string program;              // of thisProgram
    FileStates read;                  // files that decided the outcome
    FileStates written;
    int exitCode = 0; // 128 + n when signal n ended it
    bool outOfTime = false;
    double seconds = 0;
    std::size_t peakBytes = 0;
    std::string result;   // what it printed: JSON as it came, of anything else the last 4 KiB
    std::string messages; // the last 4 KiB of what it said on standard error
};

[[nodiscard]] bool isDone(const Record& record);
[[nodiscard]] std::string stateOf(const Record& record); // "done", "out of time", "killed by signal 9", "failed (1)": the exit code
[[nodiscard]] FileStates statesOf(const std::vector<std::filesystem::path>& files);
/// Whether each is there with this size and these bytes.
[[nodiscard]] bool areUnchanged(const FileStates& files);

/// In a folder of records; it depends on input and command, so that a new run replaces the old.
[[nodiscard]] std::filesystem::path recordFile(const std::filesystem::path& folder, const Record& record);
[[nodiscard]] std::string lineOf(const Record& record); // of JSON
/// TG5001; TG8105 it is not a record.
[[nodiscard]] Result<Record> readRecord(const std::filesystem::path& file);
/// All of the folder, what failed first, then by input. TG8106 it holds none; TG8105.
[[nodiscard]] Result<std::vector<Record>> readRecords(const std::filesystem::path& folder);

using Rows = std::vector<std::vector<std::string>>;
/// A header, and for each record input, state, seconds, MiB, the columns (JSON pointers into what was printed, such as /output/faces), and
/// the first message of what failed.
[[nodiscard]] Rows tableOf(const std::vector<Record>& records, const std::vector<std::string>& columns);
[[nodiscard]] report::Page pageOf(const Rows& table);

/// What is named, with * ? [] as the shell has them, then what the list holds, one a line; each input once. Empty lines and lines that
/// begin with # are passed over; "-" is standard input. TG8102 a pattern that nothing fits, or no input at all; TG5001.
[[nodiscard]] Result<std::vector<std::string>> inputsOf(const std::vector<std::string>& named, const std::string& list);
/// The words with `{}` replaced by the input, `{path}` by the input without its ending, `{file}` by its name without folders, `{name}` by
/// that without its ending.
[[nodiscard]] std::vector<std::string> commandFor(const std::vector<std::string>& words, const std::string& input);

/// The files that a command says it will write.
using OutputsOf = std::function<std::vector<std::string>(const std::vector<std::string>& command)>;
/// TG8103 no word holds `{}`; TG8104 two inputs would be written to the same file, or one over an input.
[[nodiscard]] Result<void> commandsDiffer(const std::vector<std::string>& words, const std::vector<std::string>& inputs,
                                          const OutputsOf& outputsOf);

/// The version and the bytes of the program that runs.
[[nodiscard]] Result<std::string> thisProgram(const std::string& version);

struct Batch {
    std::string program;            // file of the program whose command it is
    std::string programIdentity;    // of thisProgram
    std::vector<std::string> words; // of the command, with places to fill
    std::filesystem::path results;
    double timeLimit = 3600;  // seconds for each input
    std::size_t maxBytes = 0; // of memory for each input; 0: no limit
    unsigned jobs = 1;        // inputs at a time
};

/// Hears of each input, from one thread at a time.
using Heard = std::function<void(const Record& record, bool wasDone)>;
/// Runs the command for each input that has no good record, or whose files, read or written, are not those of the record, and writes its
/// record when it has ended: one that is stopped leaves none. An input that fails, crashes, takes too long or too much memory fails alone.
/// An error is the batch's own: TG5002 a record cannot be written, TG5003 the program cannot be started, TG8104 two inputs have written the
/// same file.
[[nodiscard]] Result<void> runBatch(const std::vector<std::string>& inputs, const Batch& batch, const Heard& heard);

} // namespace tegument::batch
