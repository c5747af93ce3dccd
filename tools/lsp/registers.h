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

/// Every entry point of the effect's passes by DXC, or by glslang where there is no DXC. What only Direct3D 9's compiler reads is left
/// alone: nothing is found wrong with it, and nothing is known of it.
[[nodiscard]] Compiled compile(const Effect& effect);

} // namespace tegument::lsp
