#pragma once
// tegument fur pose: where a body that bends takes the roots of its strands.

#include "tools/cli/commands.h"

namespace tegument::app {

void addFurPose(CLI::App& fur, Action& action);

} // namespace tegument::app
