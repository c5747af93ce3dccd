// parseWorkspace on any text: a workspace or one error with a place inside the text.
#include "host/scene/workspace.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto workspace = tegument::parseWorkspace(text, "/nowhere/w.json", {.requireMesh = false});
    if (workspace) return 0;
    if (workspace.error().diagnostics.size() != 1) std::abort();
    const auto lines = std::ranges::count(text, '\n') + 1;
    if (const int line = workspace.error().diagnostics.front().at.line; line < 1 || line > lines) std::abort();
    return 0;
}
