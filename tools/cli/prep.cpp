// tegument prep: meshes made ready for the effects.

#include "tools/cli/command_line.h"
#include "tools/cli/prep_mesh.h"

namespace tegument::app {

void addPrep(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("prep", "Prepare meshes for the effects: tegument prep IN -o OUT (docs/meshprep.md)");
    command->require_subcommand(0, 1);
    addPrepMesh(*command, action);
    addPrepShape(*command, action);
    addPrepHuman(*command, action);
    addPrepBunny(*command, action);
    addPrepLinks(*command, action);
    addPrepLight(*command, action);
    addExamples(*command, {{"prep human", "the default head, once"},
                           {"prep scan.ply -o scan.glb", "cleaned, with normals, ordered, with levels of detail"},
                           {"prep scan.obj --unit-mm 1000 --dry-run --report out/report.json", "what would change"}});
}

} // namespace tegument::app
