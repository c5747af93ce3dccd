// The commands of components that this build leaves out: they stay known, and say what brings them.

#include "host/support/file.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"
#include "tools/cli/prep_mesh.h"

#include <fmt/format.h>

namespace tegument::app {

namespace {

/// Hidden from the help; TG8051.
[[maybe_unused]] void addLeftOut(CLI::App& program, Action& action, const std::string& name, const std::string& option,
                                 const std::string& hint = {}) {
    CLI::App* command = program.add_subcommand(name, "Not part of this build");
    command->group("");
    command->allow_extras();
    command->callback([&action, name, option, hint] {
        action = [name, option, hint] {
            const std::string how = hint.empty() ? "./bootstrap build makes the whole program; or cmake -D" + option + "=ON" : hint;
            return fail(machineError(8051, fmt::format("this build leaves out tegument {}", name), how), false);
        };
    });
}

} // namespace

#ifndef TEGUMENT_WITH_VIEWER
void addView(CLI::App& program, Action& action) {
    addLeftOut(program, action, "view", "TEGUMENT_VIEWER");
}
#endif

#ifndef TEGUMENT_WITH_BATCH
void addBatch(CLI::App& program, Action& action) {
    addLeftOut(program, action, "batch", "TEGUMENT_BATCH");
}
#endif

#ifndef TEGUMENT_WITH_LSP
int serveEditor(const LoadOptions&) {
    return fail(machineError(8051, "this build leaves out tegument check --lsp",
                             "./bootstrap build makes the whole program; or cmake -DTEGUMENT_LSP=ON"),
                false);
}
#endif

#ifndef TEGUMENT_WITH_HUMAN
void addPrepHuman(CLI::App& prep, Action& action) {
    addLeftOut(
        prep, action, "human", "TEGUMENT_HUMAN",
        fmt::format("a human.glb from another build belongs in {}; --mesh takes a head of your own", (cacheFolder() / "human").string()));
}
#endif

} // namespace tegument::app
