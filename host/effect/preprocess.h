#pragma once
// The C preprocessor as HLSL uses it: no variadic macros; `#line` is read and ignored, because every token keeps the place where it was
// written.

#include "host/effect/model.h"
#include "host/effect/source.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tegument {

/// Reads a file, or says why not. Tests and the fuzzer give texts that are in no file.
using FileReader = std::function<Result<std::string>(const std::filesystem::path&)>;

/// The folder, to be named by -I, in which an include that was not found lies.
using IncludeSearch = std::function<std::optional<std::filesystem::path>(const std::string& name)>;

/// Reads the effect, and what lies within the roots; TG1014 for what is there and lies outside.
[[nodiscard]] FileReader confinedReader(const std::filesystem::path& effect, Roots roots);

struct PreprocessOptions {
    std::vector<std::pair<std::string, std::string>> defines;
    std::vector<std::filesystem::path> includeFolders;
    FileReader read;
    IncludeSearch search = {}; // none: a missing include is not looked for
    bool anyCase = false;      // include files are looked for without regard to case where their own spelling finds none
};

/// A `#pragma` that the compilers should see, before tokens[before].
struct Pragma {
    std::size_t before = 0;
    int file = 0;
    int line = 0;
    std::string text;
};

struct Preprocessed {
    std::vector<Token> tokens;
    std::vector<Pragma> pragmas;
    std::vector<std::filesystem::path> includes; // each once, in the order of first reading
    std::vector<Diagnostic> warnings;
    std::optional<EffectSettings> settings;      // FX_SETTINGS
    std::map<std::string, std::string> metadata; // FX_METADATA: entry, its switch's value
    bool ownDialect = false;                     // FX_ENTRY, FX_D3D10 or FX_D3D11 was asked for
    bool reshade = false;                        // rewritten from ReShade FX
};

/// TG1001..TG1014. The tokens point into `sources`.
[[nodiscard]] Result<Preprocessed> preprocess(const std::filesystem::path& file, const PreprocessOptions& options, Sources& sources);

} // namespace tegument
