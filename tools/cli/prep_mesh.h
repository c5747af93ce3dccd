#pragma once
// tegument prep IN -o OUT, beside the subcommands of `prep`.

#include "tools/cli/commands.h"

namespace tegument::app {

void addPrepMesh(CLI::App& prep, Action& action);
/// tegument prep bunny
void addPrepBunny(CLI::App& prep, Action& action);
void addPrepShape(CLI::App& prep, Action& action);
/// tegument prep links
void addPrepLinks(CLI::App& prep, Action& action);
/// tegument prep environment, tegument prep occlusion
void addPrepLight(CLI::App& prep, Action& action);
void addPrepHuman(CLI::App& prep, Action& action); // nothing where the build leaves it out: TEGUMENT_HUMAN

} // namespace tegument::app
