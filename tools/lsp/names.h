#pragma once
// What a file declares, and what stands at a place: from its tokens alone.

#include "host/effect/source.h"

#include <string>
#include <string_view>
#include <vector>

namespace tegument::lsp {

struct Declaration {
    std::string name;
    std::string kind; // "function", "global", "local", "struct", "macro", "technique", "pass", "block"
    std::string type; // of a function: what it returns
    std::string line; // as written, trimmed
    SourcePosition at;
    int from = 0; // of a local, first and last line of what it is seen in; 0: everywhere
    int to = 0;
};

/// What a place in a file belongs to.
enum class Context { Other, PassState, SamplerState, Value, Semantic };

struct Place {
    Context context = Context::Other;
    bool global = false; // of a semantic: at a global variable, for the host; else of a stage
    bool sampler = false;
    std::string state; // of a value: the state that gets it
};

struct FileNames {
    std::string file;
    std::vector<Declaration> declarations;
    std::vector<std::pair<int, std::string>> includes; // line, name as written
};

[[nodiscard]] FileNames namesOf(const std::string& file, const std::string& text);

/// Line from 1, column in bytes from 1, of the cursor: what would be typed there.
[[nodiscard]] Place placeAt(const std::string& text, int line, int column);

/// The word that touches this place; empty where there is none.
[[nodiscard]] std::string wordAt(std::string_view line, int column);

/// A line without its ending, from 1; empty behind the last.
[[nodiscard]] std::string_view lineOf(std::string_view text, int line);

} // namespace tegument::lsp
