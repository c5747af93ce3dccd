#pragma once
// A batch as a job array of Slurm.

#include "host/support/result.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tegument::batch {

/// The script for sbatch: an array of `shards` tasks, each of which runs `program` batch --shard I/shards with these words. A task whose
/// node dies is started again by Slurm, and does what is missing. `options` are further ones of sbatch, `logs` the folder for what tasks
/// say.
[[nodiscard]] std::string slurmScript(const std::string& program, std::size_t shards, const std::vector<std::string>& words,
                                      const std::vector<std::string>& options, const std::string& logs);

/// The job's number. TG8110 sbatch is not there or refuses.
[[nodiscard]] Result<std::string> submitToSlurm(const std::string& scriptFile);

/// Tasks of the job that wait or run; nothing where Slurm does not answer.
[[nodiscard]] std::optional<std::size_t> slurmTasksLeft(const std::string& job);

} // namespace tegument::batch
