// tegument submit: a batch as a job array of Slurm, and how far it is.

#include "host/support/file.h"
#include "tools/batch/slurm.h"
#include "tools/batch/table.h"
#include "tools/cli/batch_options.h"
#include "tools/cli/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct SubmitOptions {
    BatchOptions batch;
    bool slurm = false;
    std::size_t shards = 8;
    std::vector<std::string> sbatch;
    bool go = false;
};

/// The job's files lie beside the records, under the name of what they do.
struct JobFiles {
    fs::path list;
    fs::path script;
    fs::path logs;
};

std::string listOf(const std::vector<batch::Pending>& pending) {
    std::string text;
    for (const batch::Pending& one : pending)
        text += one.input + "\n";
    return text;
}

JobFiles filesFor(const fs::path& results, const std::string& list) {
    const fs::path jobs = fs::absolute(results) / "jobs";
    const std::string name = contentHash(list);
    return {jobs / (name + ".txt"), jobs / (name + ".sh"), jobs};
}

/// Looks until no task is left or every input has its record. What Slurm does not tell for a minute is not waited for.
Result<void> follow(const std::string& job, std::vector<batch::Pending> pending) {
    constexpr int kSilent = 30;
    Progress progress;
    const std::size_t all = pending.size();
    for (int silent = 0; silent < kSilent; std::this_thread::sleep_for(std::chrono::seconds(2))) {
        const auto left = batch::slurmTasksLeft(job); // asked first: a record that comes in between is counted
        pending = batch::stillPending(pending);
        progress.count(fmt::format("job {}", job), all - pending.size(), all);
        if (pending.empty() || left == 0U) return {};
        silent = left ? 0 : silent + 1;
    }
    return machineError(8110, fmt::format("squeue does not answer; job {} goes on without us", job), "run the same command again later");
}

/// The job that an earlier call has submitted and that still runs, or a new one: nothing is done twice.
Result<std::string> runningOrNew(const JobFiles& files, std::size_t pending) {
    const fs::path last = files.logs / "last.job";
    if (auto before = readFile(last); before && batch::slurmTasksLeft(*before).value_or(0) > 0) {
        fmt::print(stderr, "job {} is still at it: following\n", *before);
        return std::move(*before);
    }
    auto job = batch::submitToSlurm(files.script.string());
    if (!job) return job.error();
    if (auto written = writeFile(last, *job); !written) return written.error();
    fmt::print(stderr, "job {}: {} inputs; the same command again follows it, or does what is missing\n", *job, pending);
    return std::move(*job);
}

int finish(const SubmitOptions& options, const std::vector<batch::Pending>& submitted) {
    const auto missing = batch::stillPending(submitted);
    std::size_t failed = 0;
    for (const batch::Pending& one : submitted) {
        const auto record = batch::readRecord(one.record);
        if (!record || record->identity != one.identity || isDone(*record)) continue;
        ++failed;
        fmt::print("{}: {} {}\n", one.input, stateOf(*record), batch::tableOf({*record}, {}).rows.front().back());
    }
    fmt::print("{} inputs: {} done, {} failed, {} without a record; records in {}\n", submitted.size(),
               submitted.size() - failed - missing.size(), failed, missing.size(), options.batch.results);
    if (!missing.empty()) fmt::print("the same command again does what is missing\n");
    return failed + missing.size() == 0 ? 0 : 1;
}

int submit(const SubmitOptions& options, const CLI::App& program) {
    const auto inputs = batch::inputsOf(options.batch.inputs, options.batch.list);
    if (!inputs) return fail(inputs.error(), false);
    const auto batch = batchOf(options.batch, *inputs, program);
    if (!batch) return fail(batch.error(), false);
    const auto pending = batch::pendingOf(*inputs, *batch);
    if (pending.empty()) {
        fmt::print("nothing to do: {} inputs are done\n", inputs->size());
        return 0;
    }
    const std::string list = listOf(pending);
    const JobFiles files = filesFor(options.batch.results, list);
    BatchOptions own = options.batch;
    own.results = fs::absolute(own.results).string();
    const std::string script = batch::slurmScript(batch->program, std::min(options.shards, pending.size()),
                                                  sameOptions(own, files.list.string()), options.sbatch, files.logs.string());
    for (const auto& [file, text] : {std::pair{files.list, list}, {files.script, script}})
        if (const auto written = writeFile(file, text); !written) return fail(written.error(), false);
    if (!options.go) {
        fmt::print("{}", script);
        fmt::print(stderr, "sbatch {}\n", files.script.string());
        return 0;
    }
    const auto job = runningOrNew(files, pending.size());
    if (!job) return fail(job.error(), false);
    if (const auto followed = follow(*job, pending); !followed) return fail(followed.error(), false);
    return finish(options, pending);
}

} // namespace

void addSubmit(CLI::App& program, Action& action) {
    auto options = std::make_shared<SubmitOptions>();
    CLI::App* command = program.add_subcommand("submit", "A batch as a job array of Slurm: print the script, or submit and follow it");
    addBatchOptions(*command, options->batch);
    command->add_flag("--slurm", options->slurm, "The scheduler; the only one that needs more than a line")->required();
    command->add_option("--shards", options->shards, "Tasks of the array")->check(CLI::Range(1, 100000))->capture_default_str();
    repeatable(command->add_option("--sbatch", options->sbatch, "One more option of sbatch, --sbatch=--partition=short; may be repeated"));
    command->add_flag("--go", options->go, "Submit, and follow until it has ended");
    addExamples(*command,
                {{"submit --slurm --shards 100 -i 'scans/*.ply' --results done -- prep {} -o out/{name}.glb", "the script"},
                 {"submit --slurm --go -i '*.fx' --results checked -- check {} --json", "submitted and followed"}},
                "The folder of --results, the inputs and the outputs lie where every node sees them. The same command\n"
                "again does what is missing, failed or changed (docs/many.md).");
    command->callback([options, &program, &action] { action = [options, &program] { return submit(*options, program); }; });
}

} // namespace tegument::app
