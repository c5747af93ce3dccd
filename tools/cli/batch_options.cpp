#include "tools/cli/batch_options.h"

#include "host/support/system.h"
#include "meshprep/assets/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 5> kAlone{"batch", "submit", "merge", "view", "help"};

/// The file that a word of the command line names, if it does: a path, one of our effects or workspaces.
std::optional<fs::path> fileBehind(const std::string& word) {
    std::error_code code;
    if (fs::is_regular_file(word, code)) return word;
    if (word.empty() || word[0] == '-' || word.find_first_of("=/") != std::string::npos) return {};
    for (const auto& known : {assets::knownEffects(), assets::knownWorkspaces()})
        for (const fs::path& file : known)
            if (file.stem() == word || file.filename() == word) return file;
    return {};
}

std::vector<fs::path> filesBehind(const std::string& word) {
    const auto file = fileBehind(word);
    if (!file) return {};
    std::vector<fs::path> files{*file};
    if (toLower(file->extension().string()) != ".fx") return files;
    if (const auto effect = loadEffect(*file, {.lenient = true}))
        files.insert(files.end(), effect->includes.begin(), effect->includes.end());
    return files;
}

/// Remembers: most words are the same for every input.
batch::FilesBehind remembering() {
    struct Memory {
        std::mutex mutex;
        std::map<std::string, std::vector<fs::path>> files;
    };
    return [memory = std::make_shared<Memory>()](const std::string& word) {
        const std::scoped_lock lock(memory->mutex);
        const auto [at, isNew] = memory->files.try_emplace(word);
        if (isNew) at->second = filesBehind(word);
        return at->second;
    };
}

} // namespace

void addBatchOptions(CLI::App& command, BatchOptions& options) {
    command.add_option("-i,--inputs", options.inputs, "Files, or patterns with * ? [] in quotes; any number");
    command.add_option("--list", options.list, "File that lists inputs, one a line; -: standard input");
    command.add_option("--results", options.results, "Folder for the records, one for each input; machines may share it")->required();
    repeatable(command.add_option("--with", options.with,
                                  "One more file that decides the outcome, as a mesh that a workspace names; may be repeated"));
    command.add_option("--time-limit", options.timeLimit, "Seconds for each input")->check(CLI::PositiveNumber)->capture_default_str();
    command.add_option("--max-memory", options.maxMemory, "MiB of memory for each input; 0: no limit")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command.add_option("-j,--jobs", options.jobs, "Inputs at a time")->check(CLI::Range(1, 4096))->capture_default_str();
    command.add_flag("--keep-failed", options.keepsFailed, "Do not try again what failed before and has not changed");
    command.add_option("command", options.words, "Behind --: a command of this program; {} is the input, {name} its name without ending")
        ->required();
}

std::vector<std::string> sameOptions(const BatchOptions& options, const std::string& list) {
    std::vector<std::string> words{"--list",       list,
                                   "--results",    options.results,
                                   "--time-limit", fmt::format("{}", options.timeLimit),
                                   "--max-memory", fmt::format("{}", options.maxMemory),
                                   "--jobs",       fmt::format("{}", options.jobs)};
    for (const std::string& file : options.with) {
        words.emplace_back("--with");
        words.push_back(file);
    }
    if (options.keepsFailed) words.emplace_back("--keep-failed");
    words.emplace_back("--");
    words.insert(words.end(), options.words.begin(), options.words.end());
    return words;
}

Result<batch::Batch> batchOf(const BatchOptions& options, const std::vector<std::string>& inputs, const CLI::App& program) {
    const std::string& name = options.words.front();
    const auto known = program.get_subcommands([&](const CLI::App* command) { return command->get_name() == name; });
    if (known.empty() || std::ranges::find(kAlone, name) != kAlone.end())
        return usageError(8107, fmt::format("'{}' is no command that a batch can run", name), "for example -- check {} --json");
    if (auto differ = batch::commandsDiffer(options.words, inputs); !differ) return differ.error();
    auto identity = batch::thisProgram(TEGUMENT_VERSION);
    if (!identity) return identity.error();
    constexpr double kMiB = 1024.0 * 1024.0;
    return batch::Batch{.program = programFile().string(),
                        .programIdentity = std::move(*identity),
                        .words = options.words,
                        .with = {options.with.begin(), options.with.end()},
                        .filesBehind = remembering(),
                        .results = options.results,
                        .timeLimit = options.timeLimit,
                        .maxBytes = static_cast<std::size_t>(options.maxMemory * kMiB),
                        .jobs = options.jobs,
                        .keepsFailed = options.keepsFailed};
} // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks): a std::function owns what it was given

} // namespace tegument::app
