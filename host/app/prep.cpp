// tegument prep: meshes made ready for the effects.

#include "host/app/commands.h"
#include "host/app/prep_mesh.h"

#include <CLI/CLI.hpp>

namespace tegument::app {

void addPrep(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("prep", "Prepare meshes for the effects: tegument prep IN -o OUT (docs/meshprep.md)");
    command->require_subcommand(0, 1);
    addPrepMesh(*command, action);
    addPrepShape(*command, action);
    addPrepHuman(*command, action);
}

} // namespace tegument::app
