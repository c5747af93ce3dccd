#pragma once
// tegument fur strands: strands as ribbons, a part of the mesh.

#include "tools/cli/commands.h"

namespace tegument::app {

void addFurStrands(CLI::App& fur, Action& action);

} // namespace tegument::app
