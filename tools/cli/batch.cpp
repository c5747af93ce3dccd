// tegument batch: one command for many inputs, or for this machine's part of them.

#include "host/support/text.h"
#include "tools/batch/table.h"
#include "tools/cli/batch_options.h"
#include "tools/cli/output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

namespace tegument::app {

namespace {

struct ShardOptions {
    BatchOptions batch;
    std::string shard = "1/1";
    bool dryRun = false;
    bool json = false;
};

/// What went wrong, at once; as JSON every record.
void tell(const batch::Record& record, bool json) {
    if (json) return fmt::print("{}\n", batch::lineOf(record));
    if (batch::isDone(record)) return;
    const batch::Table row = batch::tableOf({record}, {});
    fmt::print("{}: {} {}\n", record.input, stateOf(record), row.rows.front().back());
}

int runPart(const ShardOptions& options, const std::vector<std::string>& part, const batch::Batch& batch) {
    Progress progress;
    std::size_t heard = 0;
    const auto sums = batch::runBatch(part, batch, [&](const batch::Record& record, bool) {
        progress.clear();
        tell(record, options.json);
        progress.count("inputs", ++heard, part.size());
    });
    progress.clear();
    if (!sums) return fail(sums.error(), options.json);
    if (!options.json)
        fmt::print("{} inputs: {} done, {} done before, {} failed; records in {}\n", part.size(), sums->done, sums->kept, sums->failed,
                   options.batch.results);
    constexpr int kMachine = 3;
    return sums->failed == 0 ? 0 : sums->worst == kMachine ? kMachine : 1;
}

int runShard(const ShardOptions& options, const CLI::App& program) {
    const auto shard = batch::shardOf(options.shard);
    if (!shard) return fail(shard.error(), options.json);
    const auto inputs = batch::inputsOf(options.batch.inputs, options.batch.list);
    if (!inputs) return fail(inputs.error(), options.json);
    const auto batch = batchOf(options.batch, *inputs, program);
    if (!batch) return fail(batch.error(), options.json);
    const std::vector<std::string> part = batch::partOf(*inputs, *shard);
    if (options.dryRun) {
        for (const std::string& input : part) {
            std::vector<std::string> words = batch::commandFor(batch->words, input);
            std::ranges::transform(words, words.begin(), shellWord);
            fmt::print("tegument {}\n", fmt::join(words, " "));
        }
        return 0;
    }
    if (const auto folder = checkFolder(options.batch.results); !folder) return fail(folder.error(), options.json);
    return runPart(options, part, *batch);
}

} // namespace

void addBatch(CLI::App& program, Action& action) {
    auto options = std::make_shared<ShardOptions>();
    CLI::App* command = program.add_subcommand("batch", "Run a command for many inputs; again, only for what is missing or failed");
    addBatchOptions(*command, options->batch);
    command->add_option("--shard", options->shard, "Part of the inputs, 3/100: every hundredth from the third on")->capture_default_str();
    command->add_flag("--dry-run", options->dryRun, "Print the commands, run none");
    command->add_flag("--json", options->json, "Print the records, one a line");
    addExamples(*command,
                {{"batch -i 'scans/*.ply' --results done -- prep {} -o prepared/{name}.glb --json", "prepare every scan"},
                 {"batch --list scans.txt --shard 3/100 --results done -- prep {} -o prepared/{name}.glb", "a hundredth of them"},
                 {"batch -i *.fx --results checked -- check {} --json", "check many effects"}},
                "{} input  {name} file name without ending  {file} file name  {path} input without ending\n"
                "An input that fails, crashes, takes too long or too much memory fails alone. A second run does\n"
                "what is missing, failed or changed. tegument merge makes the report (docs/many.md).");
    command->callback([options, &program, &action] { action = [options, &program] { return runShard(*options, program); }; });
}

} // namespace tegument::app
