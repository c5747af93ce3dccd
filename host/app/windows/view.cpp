// GLFW and Dear ImGui are left out, and with them host/view.

#include "host/app/command_line.h"
#include "host/app/output.h"
#include "host/support/windows/left_out.h"

namespace tegument::app {

void addView(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("view", "Not part of this build");
    command->group(""); // the help does not list it
    command->allow_extras();
    command->callback([&action] { action = [] { return fail(leftOut("tegument view"), false); }; });
}

} // namespace tegument::app
