#include "host/emit/flatten.h"

#include <algorithm>
#include <optional>
#include <set>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tegument {

namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 64; // as the preprocessor
constexpr std::size_t kMostBytes = 8u << 20;

struct Directive {
    int first = 0; // line
    int last = 0;  // a directive may continue behind a backslash
    std::vector<Token> tokens;

    [[nodiscard]] bool is(std::string_view name) const { return tokens.size() > 1 && tokens[1].text == name; }
    [[nodiscard]] std::string_view argument() const { return tokens.size() > 2 ? tokens[2].text : std::string_view(); }
    [[nodiscard]] bool opens() const { return is("if") || is("ifdef") || is("ifndef"); }
};

struct Scanned {
    std::vector<Directive> directives;
    bool guarded = false; // by #ifndef around everything
    bool once = false;    // by #pragma once
};

/// Everything between the first #ifndef X and its #endif, with #define X at its head and no token outside.
bool isGuarded(const std::vector<Directive>& directives, const std::vector<Token>& tokens) {
    if (directives.size() < 3 || !directives[0].is("ifndef") || !directives[1].is("define") || !directives.back().is("endif")) return false;
    if (directives[0].argument() != directives[1].argument() || directives[0].argument().empty()) return false;
    int depth = 0;
    for (std::size_t i = 0; i < directives.size(); ++i) {
        if (directives[i].opens()) ++depth;
        if (directives[i].is("endif")) --depth;
        if (depth == 0 && i + 1 < directives.size()) return false;
        if (depth == 1 && (directives[i].is("else") || directives[i].is("elif"))) return false;
    }
    return std::ranges::none_of(tokens, [&](const Token& token) {
        return token.kind != TokenKind::Newline && (token.line < directives.front().first || token.line > directives.back().last);
    });
}

Result<Scanned> scan(const Sources& sources, int file) {
    const LexResult lexed = lex(sources, file);
    if (!lexed.errors.empty()) return Error{Blame::Input, lexed.errors};
    Scanned scanned;
    for (auto at = lexed.tokens.begin(); at != lexed.tokens.end();) {
        const auto end = std::find_if(at, lexed.tokens.end(), [](const Token& t) { return t.kind == TokenKind::Newline; });
        if (at != end && at->is('#')) {
            scanned.directives.push_back({at->line, (end - 1)->line, {at, end}});
            const Directive& directive = scanned.directives.back();
            scanned.once = scanned.once || (directive.is("pragma") && directive.argument() == "once");
        }
        at = end == lexed.tokens.end() ? end : end + 1;
    }
    scanned.guarded = isGuarded(scanned.directives, lexed.tokens);
    return scanned;
}

std::vector<std::string_view> linesOf(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size() - 1);
        lines.push_back(text.substr(0, end + 1));
        text.remove_prefix(end + 1);
    }
    return lines;
}

class Flattener {
public:
    Flattener(const PreprocessOptions& options, const fs::path& file, bool mergeOnce)
        : options_(options), root_(file.parent_path()), mergeOnce_(mergeOnce) {}

    Result<std::string> run(const fs::path& file) {
        const auto text = options_.read(file);
        if (!text) return text.error();
        if (auto done = append(file, *text, 0, false); !done) return done.error();
        return std::move(result_);
    }

private:
    Result<void> fail(int code, const Token& at, std::string text, std::string hint) {
        Diagnostic diagnostic{
            .code = code, .at = sources_.position(at), .text = std::move(text), .hint = std::move(hint), .sourceLine = {}};
        quote(diagnostic, sources_);
        return Error{Blame::Input, {std::move(diagnostic)}};
    }

    /// `conditional`: whether the text is read depends on a define.
    Result<void> append(const fs::path& path, const std::string& text, int depth, bool conditional) {
        const int file = sources_.add(path.string(), std::make_shared<const std::string>(text));
        const auto scanned = scan(sources_, file);
        if (!scanned) return scanned.error();
        if (!conditional && (scanned->guarded || scanned->once)) merged_.insert(path);
        const std::string guard = scanned->once ? fmt::format("TEGUMENT_FLATTENED_{}", onceGuards_++) : "";
        if (scanned->once) result_ += fmt::format("#ifndef {0}\n#define {0}\n", guard);
        if (auto done = lines(path, text, *scanned, depth, conditional); !done) return done;
        if (!result_.empty() && result_.back() != '\n') result_ += '\n';
        if (scanned->once) result_ += fmt::format("#endif // {}\n", guard);
        return {};
    }

    Result<void> lines(const fs::path& path, const std::string& text, const Scanned& scanned, int depth, bool conditional) {
        const std::vector<std::string_view> lines = linesOf(text);
        int nested = scanned.guarded ? -1 : 0; // #if around the line, the guard not counted
        std::size_t next = 0;
        for (const Directive& directive : scanned.directives) {
            const auto first = static_cast<std::size_t>(directive.first) - 1;
            const auto behind = static_cast<std::size_t>(directive.last);
            for (; next < first; ++next)
                result_ += lines[next];
            nested += directive.opens() ? 1 : directive.is("endif") ? -1 : 0;
            if (directive.is("include")) {
                if (auto done = include(path, directive, depth, conditional || nested > 0); !done) return done;
            } else if (!(directive.is("pragma") && directive.argument() == "once")) {
                for (std::size_t line = first; line < behind; ++line)
                    result_ += lines[line];
            }
            next = behind;
        }
        for (; next < lines.size(); ++next)
            result_ += lines[next];
        return {};
    }

    Result<void> include(const fs::path& from, const Directive& directive, int depth, bool conditional) {
        const Token& at = directive.tokens.size() > 2 ? directive.tokens[2] : directive.tokens[1];
        const std::optional<std::string> name = nameOf(directive);
        if (!name) return fail(3305, at, "the name of this include comes from a macro", "write the name");
        if (result_.size() > kMostBytes) return fail(3305, at, "one file would be too long", "does a file include itself again and again?");
        if (depth + 1 > kDeepest)
            return fail(1002, at, fmt::format("includes are nested deeper than {}", kDeepest),
                        "does a file include itself without a guard?");
        for (const fs::path& folder : foldersFor(from)) {
            const fs::path path = (folder / *name).lexically_normal();
            const auto text = options_.read(path);
            if (!text) continue;
            const std::string shown = shownName(path);
            if (mergeOnce_ && merged_.contains(path)) {
                result_ += fmt::format("// ---- {} is above\n", shown);
                return {};
            }
            result_ += fmt::format("// ---- begin {}\n", shown);
            if (auto done = append(path, *text, depth + 1, conditional); !done) return done;
            result_ += fmt::format("// ---- end {}\n", shown);
            return {};
        }
        // Where it is read for certain, the preprocessor has already refused it; elsewhere the line may never be read.
        result_ += fmt::format("#include \"{}\"\n", *name);
        return {};
    }

    static std::optional<std::string> nameOf(const Directive& directive) {
        if (directive.tokens.size() < 3) return {};
        const Token& name = directive.tokens[2];
        std::string text;
        if (name.kind == TokenKind::String && name.text.size() > 2) text = name.text.substr(1, name.text.size() - 2);
        if (name.is('<')) {
            const char* begin = name.text.data() + 1;
            text.assign(begin, std::find(begin, directive.tokens.back().text.data(), '>'));
        }
        std::ranges::replace(text, '\\', '/');
        return text.empty() ? std::nullopt : std::optional(text);
    }

    [[nodiscard]] std::vector<fs::path> foldersFor(const fs::path& from) const {
        std::vector<fs::path> folders{from.parent_path()};
        folders.insert(folders.end(), options_.includeFolders.begin(), options_.includeFolders.end());
        return folders;
    }

    /// As seen from the effect; of a file elsewhere its name alone, for no path of one machine shall stand in the result.
    [[nodiscard]] std::string shownName(const fs::path& path) const {
        const fs::path relative = path.lexically_relative(root_.empty() ? "." : root_);
        return relative.empty() || relative.is_absolute() ? path.filename().string() : relative.string();
    }

    const PreprocessOptions& options_;
    fs::path root_;
    bool mergeOnce_;
    Sources sources_;
    std::set<fs::path> merged_;
    std::string result_;
    int onceGuards_ = 0;
};

/// What the compilers would see; without the place where it stands.
Result<std::vector<std::string>> tokensOf(const fs::path& file, const PreprocessOptions& options) {
    Sources sources;
    const auto preprocessed = preprocess(file, options, sources);
    if (!preprocessed) {
        Error error = preprocessed.error();
        for (Diagnostic& diagnostic : error.diagnostics)
            quote(diagnostic, sources);
        return error;
    }
    std::vector<std::string> tokens;
    for (const Token& token : preprocessed->tokens)
        tokens.emplace_back(token.text);
    return tokens;
}

/// True when `text` in place of `file` gives the same tokens for every target.
Result<bool> isFaithful(const fs::path& file, const PreprocessOptions& options, const std::string& text) {
    for (const char* target : {"", "FX_D3D10", "FX_D3D11", "FX_ENTRY"}) {
        PreprocessOptions original = options;
        if (*target != '\0') original.defines.emplace_back(target, "1");
        PreprocessOptions flat = original;
        flat.read = [&](const fs::path& path) { return path == file ? Result<std::string>(text) : options.read(path); };
        const auto before = tokensOf(file, original);
        if (!before) return before.error();
        const auto after = tokensOf(file, flat);
        if (!after || *after != *before) return false;
    }
    return true;
}

} // namespace

Result<std::string> flattenEffect(const fs::path& file, const PreprocessOptions& options) {
    if (const auto original = tokensOf(file, options); !original) return original.error();
    for (const bool mergeOnce : {true, false}) { // a file may undo its own guard to be read twice
        auto text = Flattener(options, file, mergeOnce).run(file);
        if (!text) return text;
        const auto faithful = isFaithful(file, options, *text);
        if (!faithful) return faithful.error();
        if (*faithful) return text;
    }
    return inputError(3305, {.file = file.string(), .byte = {}}, "the includes cannot be merged without changing what compilers read",
                      "does a file depend on its own name, or on __FILE__ or __LINE__?");
}

} // namespace tegument
