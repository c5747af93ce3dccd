#include "host/effect/load.h"

#include "host/effect/check.h"
#include "host/effect/code_view.h"
#include "host/effect/parser.h"
#include "host/support/file.h"

#include <algorithm>

namespace tegument {

namespace {

constexpr std::size_t kMostWarnings = 100;

Error quoted(Error error, const Sources& sources) {
    for (Diagnostic& diagnostic : error.diagnostics)
        quote(diagnostic, sources);
    return error;
}

/// After these, names may be missing that the file does declare: a check would report what is no error.
bool losesDeclarations(const Diagnostic& diagnostic) {
    return diagnostic.code >= 1101 && diagnostic.code <= 1103;
}

Result<Preprocessed> view(const std::filesystem::path& file, const LoadOptions& options, const FileReader& read, Sources& sources,
                          std::pair<std::string, std::string> define) {
    PreprocessOptions preprocessing{.defines = options.defines, .includeFolders = options.includeFolders, .read = read};
    preprocessing.defines.push_back(std::move(define));
    return preprocess(file, preprocessing, sources);
}

/// The plain HLSL. Its own errors matter only if the metadata view had none; they come from `#ifdef FX_ENTRY` branches.
Result<void> addCode(Effect& effect, const LoadOptions& options, const FileReader& read) {
    Sources sources;
    const Result<Preprocessed> code = view(effect.file, options, read, sources, {"FX_ENTRY", "1"});
    if (!code) return quoted(code.error(), sources);
    const Parsed parsed = Parser(sources, code->tokens).run();
    if (!parsed.errors.empty()) return quoted({Blame::Input, parsed.errors}, sources);
    effect.code = codeView(*code, sources, parsed.blanks);
    for (const std::filesystem::path& include : code->includes)
        if (std::ranges::find(effect.includes, include) == effect.includes.end()) effect.includes.push_back(include);
    return {};
}

} // namespace

Result<Effect> loadEffect(const std::filesystem::path& file, const LoadOptions& options, const FileReader& read) {
    Sources sources;
    const Result<Preprocessed> metadata = view(file, options, read, sources, {"FX_D3D11", "1"});
    if (!metadata) return quoted(metadata.error(), sources);
    Parsed parsed = Parser(sources, metadata->tokens).run();
    if (std::ranges::none_of(parsed.errors, losesDeclarations)) checkEffect(parsed);
    if (!parsed.errors.empty()) return quoted({Blame::Input, std::move(parsed.errors)}, sources);

    Effect effect = std::move(parsed.effect);
    effect.file = file;
    effect.defines = options.defines;
    effect.includeFolders = options.includeFolders;
    effect.includes = metadata->includes;
    effect.warnings.insert(effect.warnings.begin(), metadata->warnings.begin(), metadata->warnings.end());
    effect.warnings.resize(std::min(effect.warnings.size(), kMostWarnings));
    for (Diagnostic& warning : effect.warnings)
        quote(warning, sources);
    if (Result<void> code = addCode(effect, options, read); !code) return code.error();
    return effect;
}

Result<Effect> loadEffect(const std::filesystem::path& file, const LoadOptions& options) {
    return loadEffect(file, options, readFile);
}

} // namespace tegument
