// A build without the default human (TEGUMENT_HUMAN): prep_human.cpp is left out, and its command says so.

#include "host/app/command_line.h"
#include "host/app/output.h"
#include "host/app/prep_mesh.h"
#include "host/support/file.h"
#include "host/support/left_out.h"

#include <fmt/format.h>

namespace tegument::app {

void addPrepHuman(CLI::App& prep, Action& action) {
    CLI::App* command = prep.add_subcommand("human", "Not part of this build");
    command->group(""); // the help does not list it
    command->allow_extras();
    command->callback([&action] {
        action = [] {
            return fail(leftOut("the default head, and with it tegument prep human",
                                fmt::format("a human.glb from another build belongs in {}; --mesh takes a head of your own",
                                            (cacheFolder() / "human").string())),
                        false);
        };
    });
}

} // namespace tegument::app
