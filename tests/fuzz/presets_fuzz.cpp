// Any text is a file of presets or one error with its place.

#include "host/scene/presets.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto presets = tegument::parsePresets(text, "Fuzz.presets.json");
    if (presets) return 0;
    if (presets.error().diagnostics.size() != 1) std::abort();
    const int line = presets.error().diagnostics.front().at.line;
    if (line < 0 || line > std::ranges::count(text, '\n') + 1) std::abort();
    return 0;
}
