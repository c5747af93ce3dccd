// tegument batch: one command for many inputs, and what became of them.

#include "tools/batch/batch.h"
#include "host/support/system.h"
#include "host/support/text.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct BatchOptions {
    std::vector<std::string> inputs; // files and patterns
    std::string list;
    std::string results;
    double timeLimit = 3600; // s
    double maxMemory = 0;    // MiB
    unsigned jobs = 1;
    std::string report;
    std::vector<std::string> columns;
    bool dryRun = false;
    bool json = false;
    std::vector<std::string> words; // the command
};

const CLI::App* commandNamed(const CLI::App& parent, const std::string& name) {
    const auto found = parent.get_subcommands([&](const CLI::App* command) { return command->get_name() == name; });
    return found.empty() ? nullptr : found.front();
}

/// The files that the command will write, as its options say.
std::vector<std::string> outputsOf(const CLI::App& program, const std::vector<std::string>& command) {
    constexpr std::array<std::string_view, 5> kOptions{"-o", "--output", "--report", "--html", "--csv"};
    std::vector<std::string> outputs;
    for (std::size_t i = 0; i < command.size(); ++i)
        for (const std::string_view option : kOptions) {
            const std::string joined = fmt::format("{}{}", option, option.starts_with("--") ? "=" : "");
            if (command[i] == option && i + 1 < command.size()) outputs.push_back(command[i + 1]);
            if (command[i] != option && command[i].starts_with(joined)) outputs.push_back(command[i].substr(joined.size()));
        }
    if (!outputs.empty() || command.size() < 2) return outputs;
    if (command.front() == "render") return {fmt::format("out/{}.png", fs::path(command[1]).stem().string())};
    const CLI::App* chosen = commandNamed(program, command.front());
    if (const CLI::App* inner = commandNamed(*chosen, command[1])) chosen = inner;
    const CLI::Option* usual = chosen->get_option_no_throw("--output");
    return usual && !usual->get_default_str().empty() ? std::vector{usual->get_default_str()} : outputs;
}

/// What went wrong, at once; as JSON every record.
void tell(const batch::Record& record, bool json) {
    if (json) return fmt::print("{}\n", batch::lineOf(record));
    if (batch::isDone(record)) return;
    fmt::print("{}: {} {}\n", record.input, stateOf(record), batch::tableOf({record}, {}).back().back());
}

Result<int> run(const BatchOptions& options, const CLI::App& program) {
    const auto inputs = batch::inputsOf(options.inputs, options.list);
    if (!inputs) return inputs.error();
    constexpr std::array<std::string_view, 3> kAlone{"batch", "view", "help"};
    const std::string& name = options.words.front();
    if (!commandNamed(program, name) || std::ranges::find(kAlone, name) != kAlone.end())
        return usageError(8107, fmt::format("'{}' is no command that a batch can run", name), "for example -- check {} --json");
    const auto outputs = [&](const std::vector<std::string>& command) { return outputsOf(program, command); };
    if (auto differ = batch::commandsDiffer(options.words, *inputs, outputs); !differ) return differ.error();
    if (options.dryRun) {
        for (const std::string& input : *inputs) {
            std::vector<std::string> words = batch::commandFor(options.words, input);
            std::ranges::transform(words, words.begin(), shellWord);
            fmt::print("tegument {}\n", fmt::join(words, " "));
        }
        return 0;
    }
    if (const auto folder = checkFolder(options.results); !folder) return folder.error();
    const auto identity = batch::thisProgram(TEGUMENT_VERSION);
    if (!identity) return identity.error();
    const batch::Batch batch{.program = programFile().string(),
                             .programIdentity = *identity,
                             .words = options.words,
                             .results = options.results,
                             .timeLimit = options.timeLimit,
                             .maxBytes = static_cast<std::size_t>(options.maxMemory * 0x1p20),
                             .jobs = options.jobs};
    Progress progress;
    std::size_t before = 0;
    std::size_t failed = 0;
    std::size_t heard = 0;
    int worst = 0;
    const auto ran = batch::runBatch(*inputs, batch, [&](const batch::Record& record, bool wasDone) {
        progress.clear();
        tell(record, options.json);
        before += wasDone ? 1 : 0;
        failed += isDone(record) ? 0 : 1;
        worst = std::max(worst, record.exitCode);
        progress.count("inputs", ++heard, inputs->size());
    });
    progress.clear();
    if (!ran) return ran.error();
    if (!options.json)
        fmt::print("{}: {} done, {} done before, {} failed; records in {}\n", counted(heard, "input"), heard - before - failed, before,
                   failed, options.results);
    return failed == 0 ? 0 : worst == 3 ? 3 : 1; // the machine, or an input
}

/// Of every record in the folder.
Result<void> report(const BatchOptions& options) {
    const auto records = batch::readRecords(options.results);
    if (!records) return records.error();
    const batch::Rows rows = tableOf(*records, options.columns);
    if (!options.report.empty()) {
        const auto written = report::write(options.report, batch::pageOf(rows));
        if (written && !options.json) fmt::print("wrote {}\n", options.report);
        return written;
    }
    for (const batch::Record& record : *records)
        if (options.json) fmt::print("{}\n", lineOf(record));
    if (!options.json) fmt::print("{}", table(rows.front(), {rows.begin() + 1, rows.end()}));
    return {};
}

int runBatch(BatchOptions options, const CLI::App& program) {
    if (!options.words.empty() && options.words.front() == "--") options.words.erase(options.words.begin()); // parse() wrote it twice
    if (const auto can = checkOutput(options.report, {".html"}); !can) return fail(can.error(), options.json);
    const auto ended = options.words.empty() ? Result<int>(0) : run(options, program);
    if (!ended) return fail(ended.error(), options.json);
    if (options.words.empty() || !options.report.empty())
        if (const auto told = report(options); !told) return fail(told.error(), options.json);
    return *ended;
}

} // namespace

void addBatch(CLI::App& program, Action& action) {
    auto options = std::make_shared<BatchOptions>();
    CLI::App* command = program.add_subcommand("batch", "Run a command for many inputs; again, only for what is missing or failed");
    command->add_option("-i,--inputs", options->inputs, "Files, or patterns with * ? [] in quotes; any number");
    command->add_option("--list", options->list, "File that lists inputs, one a line; -: standard input");
    command->add_option("--results", options->results, "Folder for the records, one for each input")->required();
    command->add_option("--time-limit", options->timeLimit, "Seconds for each input")->check(CLI::PositiveNumber)->capture_default_str();
    command->add_option("--max-memory", options->maxMemory, "MiB of memory for each input; 0: no limit")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_option("-j,--jobs", options->jobs, "Inputs at a time")->check(CLI::Range(1, 4096))->capture_default_str();
    command->add_option("--report", options->report, "Write the table of all records as a page to sort and filter, .html");
    repeatable(command->add_option("--column", options->columns,
                                   "One more column: a JSON pointer into what the command printed, /output/faces; may be repeated"));
    command->add_flag("--dry-run", options->dryRun, "Print the commands, run none");
    command->add_flag("--json", options->json, "Print the records, one a line");
    command->add_option("command", options->words,
                        "Behind --: a command of this program; {} is the input, {name} its name without ending; none: the table alone");
    addExamples(*command,
                {{"batch --results done -i 'scans/*.ply' -- prep {} -o prepared/{name}.glb --json", "prepare every scan"},
                 {"batch --results checked -j 2 -i *.fx -- check {} --json", "check many effects"},
                 {"batch --results done --column /output/faces --report done.html", "what became of them"}},
                "{} input  {name} file name without ending  {file} file name  {path} input without ending\n"
                "An input that fails, crashes, takes too long or too much memory fails alone. A second run does\n"
                "what failed, and what has changed, is cut or is gone: inputs and outputs (docs/command-line.md).");
    command->callback([options, &program, &action] { action = [options, &program] { return runBatch(*options, program); }; });
}

} // namespace tegument::app
