#pragma once
// Definition, hover and completion.
// What the compilers make of an effect: their messages, and where its parameters end up.

#include "host/effect/model.h"
#include "tools/lsp/names.h"
#include "tools/lsp/rpc.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tegument::lsp {

struct Compiled {
    std::vector<Diagnostic> diagnostics;                       // each once
    std::map<std::string, std::vector<std::string>> registers; // of a parameter: "c3 in SkinPS", "t0 in SkinPS"
};

/// Every entry point that is drawn, by DXC; of another host's effect as meshprep/adopt spells it. Where there is no DXC glslang compiles
/// what it can read: of the words of Direct3D 9 nothing is said.
[[nodiscard]] Compiled compile(const Effect& effect);

/// What is asked, and what is known: the file with the cursor first, then all that it includes, and what includes it.
struct Question {
    const std::string& text; // of the file with the cursor
    int line = 0;            // from 1
    int column = 0;          // in bytes, from 1
    const std::vector<FileNames>& files;
    const Effect* effect = nullptr;                                             // as it was last read without an error
    const Compiled* compiled = nullptr;                                         // likewise
    const std::vector<std::string>& semantics;                                  // that the host binds
    std::function<std::optional<std::string>(const std::string& name)> include; // the path of what this file includes by that name
};

/// Where the word is declared; none where it is not known. Line 1 of a file for an #include.
[[nodiscard]] std::optional<SourcePosition> definition(const Question& question);
/// Markdown; none where there is nothing to say.
[[nodiscard]] std::optional<std::string> hover(const Question& question);
/// A list of {label, kind, detail}.
[[nodiscard]] Json completion(const Question& question);

} // namespace tegument::lsp
