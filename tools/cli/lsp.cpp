// tegument check --lsp: what an editor asks.

#include "host/run/semantics.h"
#include "tools/cli/commands.h"
#include "tools/lsp/server.h"
#include "tools/test/run.h"

#include <unistd.h>

namespace tegument::app {

namespace {

/// By one compiler: an editor marks a place once.
std::vector<Diagnostic> failures(const LoadOptions& load, const std::string& path) {
    static Result<gpu::Device> device = gpu::Device::create({});
    if (!device) return device.error().diagnostics;
    auto ran = testing::runFile(*device, path, {.read = {.load = load}, .compilers = {defaultCompiler()}});
    if (!ran) return ran.error().diagnostics;
    std::vector<Diagnostic> all = std::move(ran->diagnostics);
    for (const testing::TestResult& test : ran->tests)
        for (const testing::Failure& failure : test.failures)
            all.push_back(failure.message);
    return all;
}

} // namespace

int serveEditor(const LoadOptions& load) {
    return lsp::serve(
        STDIN_FILENO, STDOUT_FILENO,
        {.load = load, .semantics = run::numericSemantics(), .test = [&](const std::string& path) { return failures(load, path); }});
}

} // namespace tegument::app
