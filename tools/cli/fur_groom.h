#pragma once
// tegument fur info, import, export: strands that are curves, from and to other programs (docs/design/grooms.md).

#include "tools/cli/commands.h"

namespace tegument::app {

void addFurGroom(CLI::App& fur, Action& action);

} // namespace tegument::app
