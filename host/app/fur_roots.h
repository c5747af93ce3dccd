#pragma once
// tegument fur roots: where strands stand on a mesh, as a texture.

#include "host/app/commands.h"

namespace tegument::app {

void addFurRoots(CLI::App& fur, Action& action);

} // namespace tegument::app
