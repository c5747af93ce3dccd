#include "tools/batch/batch.h"

#include "host/support/file.h"
#include "host/support/kept_inputs.h"
#include "host/support/parallel.h"
#include "host/support/system.h"
#include "host/support/temporary.h"
#include "host/support/text.h"
#include "tools/process/process.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <sstream>
#include <unordered_set>

namespace tegument::batch {

namespace fs = std::filesystem;

namespace {

void replace(std::string& text, std::string_view what, const std::string& by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
}

/// One name for a file, whatever leads to it.
fs::path oneName(const fs::path& path) {
    std::error_code code;
    const fs::path name = fs::weakly_canonical(path, code);
    return code ? fs::absolute(path).lexically_normal() : name;
}

std::string tail(const std::string& text) {
    return text.substr(text.size() - std::min<std::size_t>(text.size(), 4096));
}

/// Reads the record of before; whether nothing that it depends on has changed.
bool wasDone(const Batch& batch, Record& record) {
    auto before = readRecord(recordFile(batch.results, record));
    if (!before || !isDone(*before) || before->program != batch.programIdentity) return false;
    if (!areUnchanged(before->read) || !areUnchanged(before->written)) return false;
    record = std::move(*before);
    return true;
}

/// Fills the record that has an input and a command.
Result<void> run(const Batch& batch, Record& record) {
    const fs::path file = fs::absolute(recordFile(batch.results, record));
    std::error_code code;
    fs::create_directories(file.parent_path(), code);
    const Temporary used(fs::path(file) += ".used"); // beside the record: the folder for temporary files need not be one
    const fs::path& list = used.path();
    ProcessCommand process{{batch.program}, {{kFilesUsedVariable, list.string()}}, true, batch.maxBytes}; // with stderr apart
    process.arguments.insert(process.arguments.end(), record.command.begin(), record.command.end());
    const auto begunAt = fs::file_time_type::clock::now();
    const auto begun = std::chrono::steady_clock::now();
    auto ran = runProcess(process, batch.timeLimit);
    if (!ran) return ran.error();
    record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    const FilesUsed files = filesUsed(list);
    record.program = batch.programIdentity;
    record.read = statesOf(files.read);
    for (auto& [name, state] : record.read)
        if (fs::last_write_time(name, code) > begunAt) state.hash.clear(); // written while the command ran
    record.written = statesOf(files.written);
    record.exitCode = ran->exitCode;
    record.outOfTime = ran->timedOut;
    record.peakBytes = ran->peakBytes;
    record.result = nlohmann::json::accept(ran->output) ? std::move(ran->output) : tail(ran->output);
    record.messages = tail(ran->errors);
    return rewriteFile(file, lineOf(record) + "\n");
}

} // namespace

Result<std::vector<std::string>> inputsOf(const std::vector<std::string>& named, const std::string& list) {
    std::vector<std::string> all;
    std::unordered_set<std::string> known;
    const auto add = [&](const std::string& input) {
        if (known.insert(input).second) all.push_back(input);
    };
    for (const std::string& input : named) {
        const bool isPattern = input.find_first_of("*?[") != std::string::npos;
        const std::vector<std::string> found = isPattern ? filesLike(input) : std::vector{input};
        if (found.empty()) return usageError(8102, fmt::format("no file fits '{}'", input));
        std::ranges::for_each(found, add);
    }
    if (!list.empty()) {
        const auto text = list == "-" ? readStandardInput() : readFile(list);
        if (!text) return text.error();
        std::istringstream lines(*text);
        for (std::string line; std::getline(lines, line);)
            if (const std::string input(trim(line)); !input.empty() && input[0] != '#') add(input);
    }
    if (all.empty()) return usageError(8102, "there is no input", "name files or patterns, or a file that lists them with --list");
    return all;
}

std::vector<std::string> commandFor(const std::vector<std::string>& words, const std::string& input) {
    const fs::path path(input);
    std::vector<std::string> command = words;
    for (std::string& word : command) {
        replace(word, "{path}", fs::path(path).replace_extension().string());
        replace(word, "{file}", path.filename().string());
        replace(word, "{name}", path.stem().string());
        replace(word, "{}", input);
    }
    return command;
}

Result<void> commandsDiffer(const std::vector<std::string>& words, const std::vector<std::string>& inputs, const OutputsOf& outputsOf) {
    if (std::ranges::none_of(words, [](const std::string& word) { return word.find("{}") != std::string::npos; }))
        return usageError(8103, "no word of the command is {}, where each input goes", "for example -- prep {} -o prepared/{name}.glb");
    constexpr const char* kHint = "{path} keeps the folders, {file} the ending, {name} is the name without ending";
    std::unordered_set<std::string> read;
    for (const std::string& input : inputs)
        read.insert(oneName(input).string());
    std::map<fs::path, std::string> writtenBy;
    for (const std::string& input : inputs)
        for (const std::string& output : outputsOf(commandFor(words, input))) {
            const fs::path name = oneName(output);
            if (read.contains(name.string()))
                return usageError(8104, fmt::format("{} would be written over the input {}", input, output), kHint);
            if (const auto [first, isNew] = writtenBy.emplace(name, input); !isNew && first->second != input)
                return usageError(8104, fmt::format("{} and {} would both be written to {}", first->second, input, output), kHint);
        }
    return {};
}

Result<std::string> thisProgram(const std::string& version) {
    const auto bytes = readFile(programFile());
    if (!bytes) return bytes.error();
    return fmt::format("{} {}", version, contentHash(*bytes));
}

Result<void> runBatch(const std::vector<std::string>& inputs, const Batch& batch, const Heard& heard) {
    std::mutex mutex;
    std::map<std::string, std::string> writtenBy;
    const auto one = [&](std::size_t i) -> Result<void> {
        Record record{.input = inputs[i], .command = commandFor(batch.words, inputs[i])};
        const bool done = wasDone(batch, record);
        if (!done)
            if (auto ran = run(batch, record); !ran) return ran;
        const std::scoped_lock lock(mutex);
        for (const auto& [file, state] : record.written)
            if (const auto [first, isNew] = writtenBy.emplace(file, inputs[i]); !isNew)
                return usageError(8104, fmt::format("{} and {} have both written {}", first->second, inputs[i], file),
                                  "give each output the input's {name}");
        if (heard) heard(record, done);
        return {};
    };
    return tryEachInParallel(inputs.size(), one, {}, batch.jobs);
}

} // namespace tegument::batch
