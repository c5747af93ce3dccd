#pragma once
// The subcommands. Each adds itself to the command line and runs when chosen; its return value is the exit code.

#include "host/support/result.h"

#include <functional>
#include <string>

namespace CLI {
class App;
}
namespace tegument {
struct LoadOptions;
}

namespace tegument::app {

/// What the chosen subcommand left to do after parsing.
using Action = std::function<int()>;

void addRender(CLI::App& program, Action& action);
void addPortrait(CLI::App& program, Action& action);
void addCheck(CLI::App& program, Action& action);
void addTest(CLI::App& program, Action& action);
void addFlatten(CLI::App& program, Action& action);
void addInfo(CLI::App& program, Action& action);
void addList(CLI::App& program, Action& action);
void addPrep(CLI::App& program, Action& action);
void addFur(CLI::App& program, Action& action);
void addSurvey(CLI::App& program, Action& action);
void addSheet(CLI::App& program, Action& action);
void addCompare(CLI::App& program, Action& action);
void addView(CLI::App& program, Action& action);
void addBatch(CLI::App& program, Action& action);

/// tegument check --lsp: until the editor says exit. Its exit code.
int serveEditor(const LoadOptions& load);

/// Those of the laboratory, with their lines in the footer: in lab/app. Nothing where the build leaves it out: TEGUMENT_LAB.
void addLab(CLI::App& program, Action& action);

} // namespace tegument::app
