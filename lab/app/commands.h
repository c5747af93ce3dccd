#pragma once
// The subcommands of the laboratory.

#include "tools/cli/commands.h"

namespace tegument::app {

void addBench(CLI::App& program, Action& action);
void addVerify(CLI::App& program, Action& action);
void addInvariance(CLI::App& program, Action& action);

} // namespace tegument::app
