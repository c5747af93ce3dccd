#include "tools/batch/slurm.h"

#include "host/support/process.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::batch {

namespace {

constexpr double kAnswers = 60; // seconds that Slurm's programs may take

/// As one word of a POSIX shell, whatever it holds.
std::string shellWord(const std::string& word) {
    std::string quoted = "'";
    for (const char c : word)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

} // namespace

std::string slurmScript(const std::string& program, std::size_t shards, const std::vector<std::string>& words,
                        const std::vector<std::string>& options, const std::string& logs) {
    std::string script = fmt::format("#!/bin/sh\n#SBATCH --job-name=tegument\n#SBATCH --array=1-{}\n#SBATCH --output={}/%A_%a.txt\n"
                                     "#SBATCH --requeue\n",
                                     shards, logs);
    for (const std::string& option : options)
        script += fmt::format("#SBATCH {}\n", option);
    script += fmt::format("exec {} batch --shard \"$SLURM_ARRAY_TASK_ID/{}\"", shellWord(program), shards);
    for (const std::string& word : words)
        script += " " + shellWord(word);
    return script + "\n";
}

Result<std::string> submitToSlurm(const std::string& scriptFile) {
    const auto ran = runProcess({.arguments = {"sbatch", "--parsable", scriptFile}, .environment = {}}, kAnswers);
    if (!ran) return machineError(8110, "there is no sbatch here", "without --go the script is printed: submit it where Slurm is");
    if (ran->exitCode != 0) return machineError(8110, fmt::format("sbatch refuses the job: {}", trim(ran->output)));
    const std::string number = ran->output.substr(0, ran->output.find_first_of(";\n")); // "12" or "12;cluster"
    return number;
}

std::optional<std::size_t> slurmTasksLeft(const std::string& job) {
    const auto ran =
        runProcess({.arguments = {"squeue", "--noheader", "--array", "--jobs", job, "--format", "%i"}, .environment = {}}, kAnswers);
    if (!ran) return {};
    if (ran->exitCode != 0) return ran->output.find("Invalid job id") != std::string::npos ? std::optional<std::size_t>(0) : std::nullopt;
    return static_cast<std::size_t>(std::ranges::count(ran->output, '\n'));
}

} // namespace tegument::batch
