#pragma once
// tegument prep IN -o OUT, beside the subcommands of `prep`.

#include "host/app/commands.h"

namespace tegument::app {

void addPrepMesh(CLI::App& prep, Action& action);
void addPrepShape(CLI::App& prep, Action& action);
void addPrepHuman(CLI::App& prep, Action& action); // where the build has it: TEGUMENT_HUMAN

} // namespace tegument::app
