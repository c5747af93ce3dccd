// tegument check --lsp: what an editor asks.

#include "host/run/semantics.h"
#include "tools/cli/commands.h"
#include "tools/lsp/server.h"

#include <unistd.h>

namespace tegument::app {

int serveEditor(const LoadOptions& load) {
    return lsp::serve(STDIN_FILENO, STDOUT_FILENO, {.load = load, .semantics = run::numericSemantics()});
}

} // namespace tegument::app
