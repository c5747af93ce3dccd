// A build without the laboratory (TEGUMENT_LAB): lab is left out, and its commands say so.

#include "tools/cli/command_line.h"
#include "tools/cli/output.h"

#include <fmt/format.h>

namespace tegument::app {

void addLab(CLI::App& program, Action& action) {
    for (const char* name : {"verify", "invariance", "bench"}) {
        CLI::App* command = program.add_subcommand(name, "Not part of this build");
        command->group(""); // the help does not list it
        command->allow_extras();
        command->callback([name, &action] {
            action = [name] {
                return fail(machineError(8046, fmt::format("this build leaves the laboratory out, and with it tegument {}", name),
                                         "./bootstrap build makes the whole program; or cmake -DTEGUMENT_LAB=ON"),
                            false);
            };
        });
    }
}

} // namespace tegument::app
