#include "host/effect/load.h"

#include "host/effect/check.h"
#include "host/effect/code_view.h"
#include "host/effect/parser.h"
#include "host/support/kept_inputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tegument {

namespace {

constexpr std::size_t kMostWarnings = 100;

/// How files are read, and where one that is missing lies.
struct Access {
    FileReader read;
    IncludeSearch search = {};
};

Access accessTo(const std::filesystem::path& file, const Roots& roots) {
    return {.read = confinedReader(file, roots), .search = [=](const std::string& name) { return folderOfInclude(name, file, roots); }};
}

Error quoted(Error error, const Sources& sources) {
    for (Diagnostic& diagnostic : error.diagnostics)
        quote(diagnostic, sources);
    return error;
}

/// After these, names may be missing that the file does declare: a check would report what is no error.
bool losesDeclarations(const Diagnostic& diagnostic) {
    return diagnostic.code >= 1101 && diagnostic.code <= 1103;
}

Result<Preprocessed> view(const std::filesystem::path& file, const LoadOptions& options, const Access& access, Sources& sources,
                          std::pair<std::string, std::string> define) {
    PreprocessOptions preprocessing{.defines = options.defines,
                                    .includeFolders = options.includeFolders,
                                    .read = access.read,
                                    .search = access.search,
                                    .anyCase = options.lenient};
    preprocessing.defines.push_back(std::move(define));
    return preprocess(file, preprocessing, sources);
}

/// The plain HLSL. Its own errors matter only if the metadata view had none; they come from `#ifdef FX_ENTRY` branches.
Result<void> addCode(Effect& effect, const LoadOptions& options, const Access& access) {
    Sources sources;
    const Result<Preprocessed> code = view(effect.file, options, access, sources, {"FX_ENTRY", "1"});
    if (!code) return quoted(code.error(), sources);
    const Parsed parsed = Parser(sources, code->tokens, options.lenient && !code->ownDialect).run();
    if (!parsed.errors.empty()) return quoted({Blame::Input, parsed.errors}, sources);
    effect.code = codeView(*code, sources, parsed.blanks) + parsed.assembled;
    for (const std::filesystem::path& include : code->includes)
        if (std::ranges::find(effect.includes, include) == effect.includes.end()) effect.includes.push_back(include);
    return {};
}

/// The setting asked for as a definition of its switch. The preprocessor alone finds which that is.
Result<LoadOptions> withSetting(const std::filesystem::path& file, LoadOptions options, const Access& access) {
    if (options.setting.empty()) return options;
    Sources sources;
    const Result<Preprocessed> plain = view(file, options, access, sources, {"FX_D3D11", "1"});
    if (!plain) return quoted(plain.error(), sources);
    const std::vector<std::string> names = plain->settings ? plain->settings->names : std::vector<std::string>();
    const auto found = std::ranges::find(names, options.setting);
    if (found == names.end())
        return usageError(4051, fmt::format("{} has no setting '{}'", file.string(), options.setting),
                          names.empty() ? "it has none at all: no FX_SETTINGS" : fmt::format("{}", fmt::join(names, ", ")));
    options.defines.emplace_back(plain->settings->define, std::to_string(found - names.begin()));
    options.setting.clear();
    return options;
}

Result<Effect> load(const std::filesystem::path& file, const LoadOptions& options, const Access& access, const char* target) {
    Sources sources;
    Result<Preprocessed> metadata = view(file, options, access, sources, {target, "1"});
    if (!metadata) return quoted(metadata.error(), sources);
    const bool lenient = options.lenient && !metadata->ownDialect;
    Parsed parsed = Parser(sources, metadata->tokens, lenient).run();
    if (std::ranges::none_of(parsed.errors, losesDeclarations)) checkEffect(parsed, lenient);
    if (!parsed.errors.empty()) return quoted({Blame::Input, std::move(parsed.errors)}, sources);

    Effect effect = std::move(parsed.effect);
    effect.file = file;
    effect.defines = options.defines;
    effect.includeFolders = options.includeFolders;
    effect.roots.anywhere = true;
    effect.includes = metadata->includes;
    effect.ownDialect = metadata->ownDialect;
    effect.settings = std::move(metadata->settings);
    effect.metadata = std::move(metadata->metadata);
    effect.warnings.insert(effect.warnings.begin(), metadata->warnings.begin(), metadata->warnings.end());
    effect.warnings.resize(std::min(effect.warnings.size(), kMostWarnings));
    for (Diagnostic& warning : effect.warnings)
        quote(warning, sources);
    if (Result<void> code = addCode(effect, options, access); !code) return code.error();
    return effect;
}

Result<Effect> loadFrom(const std::filesystem::path& file, const LoadOptions& options, const Access& access, const char* target) {
    const auto chosen = withSetting(file, options, access);
    return chosen ? load(file, *chosen, access, target) : chosen.error();
}

} // namespace

Result<Effect> loadEffect(const std::filesystem::path& file, const LoadOptions& options, const FileReader& read) {
    return loadFrom(file, options, {.read = read}, "FX_D3D11");
}

Result<Effect> loadEffect(const std::filesystem::path& file, const LoadOptions& options) {
    Roots roots = rootsOfEffect(file, options.includeFolders, options.roots);
    auto effect = loadFrom(file, options, accessTo(file, roots), "FX_D3D11");
    if (!effect) // an include that is to be written counts as one that is not there
        if (const auto kept = inputsAreKept(); !kept) return kept.error();
    if (effect) effect->roots = std::move(roots);
    return effect;
}

Result<Effect> loadEffectOfDirect3D9(const std::filesystem::path& file, const LoadOptions& options) {
    return loadFrom(file, options, accessTo(file, rootsOfEffect(file, options.includeFolders, options.roots)), "FX_D3D9");
}

} // namespace tegument
