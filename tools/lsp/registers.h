#pragma once
// What the compilers make of an effect: their messages, and where its parameters end up.

#include "host/effect/model.h"

#include <map>
#include <string>
#include <vector>

namespace tegument::lsp {

struct Compiled {
    std::vector<Diagnostic> diagnostics;                       // each once
    std::map<std::string, std::vector<std::string>> registers; // of a parameter: "c3 in SkinPS", "t0 in SkinPS"
};

/// Every entry point that is drawn, by DXC; of another host's effect as host/adopt spells it. Where there is no DXC glslang compiles what
/// it can read: of the words of Direct3D 9 nothing is said.
[[nodiscard]] Compiled compile(const Effect& effect);

} // namespace tegument::lsp
