#include "tools/emit/flatten.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
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
    std::size_t needs = 0; // directives before the guard: #ifndef X, #include, #endif of files that this one needs
    bool guarded = false;  // by #ifndef around everything but these
    bool once = false;     // by #pragma once

    [[nodiscard]] std::string_view guard() const { return guarded ? directives[needs].argument() : std::string_view(); }
};

/// How many directives at the beginning include, each behind a guard, what the file needs.
std::size_t needsOf(const std::vector<Directive>& directives) {
    std::size_t at = 0;
    while (at + 2 < directives.size() && directives[at].is("ifndef") && directives[at + 1].is("include") && directives[at + 2].is("endif"))
        at += 3;
    return at;
}

/// Everything between the first #ifndef X and its #endif, with #define X at its head and no token outside.
bool isGuarded(std::span<const Directive> directives, std::span<const Token> tokens) {
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
    scanned.needs = needsOf(scanned.directives);
    const std::span all(scanned.directives);
    const auto isNeed = [&](const Token& token) {
        return std::ranges::any_of(all.first(scanned.needs),
                                   [&](const Directive& d) { return token.line >= d.first && token.line <= d.last; });
    };
    std::vector<Token> code;
    std::ranges::remove_copy_if(lexed.tokens, std::back_inserter(code), isNeed);
    scanned.guarded = isGuarded(all.subspan(scanned.needs), code);
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

    [[nodiscard]] const std::set<std::string, std::less<>>& guards() const { return guards_; }

private:
    Result<void> fail(int code, const Token& at, std::string text, std::string hint) {
        Diagnostic diagnostic{.code = code, .at = sources_.position(at), .text = std::move(text), .hint = std::move(hint)};
        quote(diagnostic, sources_);
        return Error{Blame::Input, {std::move(diagnostic)}};
    }

    /// `conditional`: whether the text is read depends on a define.
    Result<void> append(const fs::path& path, const std::string& text, int depth, bool conditional) {
        const int file = sources_.add(path.string(), std::make_shared<const std::string>(text));
        const auto scanned = scan(sources_, file);
        if (!scanned) return scanned.error();
        if (!conditional && (scanned->guarded || scanned->once)) merged_.insert(path);
        if (scanned->guarded) guards_.emplace(scanned->guard());
        const std::string guard = scanned->once ? fmt::format("TEGUMENT_FLATTENED_{}", onceGuards_++) : "";
        if (scanned->once) result_ += fmt::format("#ifndef {0}\n#define {0}\n", guard);
        if (auto done = lines(path, text, *scanned, depth, conditional); !done) return done;
        if (!result_.empty() && result_.back() != '\n') result_ += '\n';
        if (scanned->once) result_ += fmt::format("#endif // {}\n", guard);
        return {};
    }

    Result<void> lines(const fs::path& path, const std::string& text, const Scanned& scanned, int depth, bool conditional) {
        const std::vector<std::string_view> lines = linesOf(text);
        int nested = 0; // #if around the line, the guard not counted
        std::size_t next = 0;
        for (std::size_t i = 0; i < scanned.directives.size(); ++i) {
            const Directive& directive = scanned.directives[i];
            if (scanned.guarded && i == scanned.needs) --nested;
            if (i < scanned.needs && i % 3 == 0 && isAbove(path, scanned.directives[i + 1])) {
                for (; next + 1 < static_cast<std::size_t>(directive.first); ++next)
                    result_ += lines[next];
                i += 2;
                next = static_cast<std::size_t>(scanned.directives[i].last);
                continue;
            }
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
        for (const fs::path& path : placesOf(from, *name)) {
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

    /// Where an include may lie, in the order in which it is looked for.
    [[nodiscard]] std::vector<fs::path> placesOf(const fs::path& from, const std::string& name) const {
        std::vector<fs::path> places{(from.parent_path() / name).lexically_normal()};
        for (const fs::path& folder : options_.includeFolders)
            places.push_back((folder / name).lexically_normal());
        return places;
    }

    /// Whether what this #include names has been read for certain.
    [[nodiscard]] bool isAbove(const fs::path& from, const Directive& directive) const {
        const std::optional<std::string> name = nameOf(directive);
        return mergeOnce_ && name && std::ranges::any_of(placesOf(from, *name), [&](const fs::path& p) { return merged_.contains(p); });
    }

    /// As seen from the effect; of a file elsewhere its name alone, for no path of one machine shall stand in the result.
    [[nodiscard]] std::string shownName(const fs::path& path) const {
        const fs::path relative = path.lexically_relative(root_.empty() ? "." : root_);
        return relative.empty() || relative.is_absolute() ? path.filename().string() : relative.generic_string();
    }

    const PreprocessOptions& options_;
    fs::path root_;
    bool mergeOnce_;
    Sources sources_;
    std::set<fs::path> merged_;
    std::set<std::string, std::less<>> guards_; // of all files
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

/// True when `text` in place of `file`, which is read with `known` defined, gives the same tokens for every target.
Result<bool> isFaithful(const fs::path& file, const PreprocessOptions& options, const std::string& text,
                        std::span<const char* const> targets, const std::string& known = {}) {
    for (const char* target : targets) {
        PreprocessOptions original = options;
        if (*target != '\0') original.defines.emplace_back(target, "1");
        PreprocessOptions flat = original;
        if (!known.empty()) original.defines.emplace_back(known, "1");
        flat.read = [&](const fs::path& path) { return path == file ? Result<std::string>(text) : options.read(path); };
        const auto before = tokensOf(file, original);
        if (!before) return before.error();
        const auto after = tokensOf(file, flat);
        if (!after || *after != *before) return false;
    }
    return true;
}

constexpr const char* kLibrary = "TEGUMENT_LIBRARY";

/// A text whose conditionals are decided as far as they ask for names that are known: one that is defined, and include guards, which are
/// defined where the text defines them.
class Decided {
public:
    Decided(std::string known, const std::set<std::string, std::less<>>& guards) {
        known_.emplace(std::move(known), true);
        for (const std::string& guard : guards)
            known_.emplace(guard, false);
    }

    Result<std::string> run(const std::string& text) {
        Sources sources;
        const auto scanned = scan(sources, sources.add("library", std::make_shared<const std::string>(text)));
        if (!scanned) return scanned.error();
        const std::vector<std::string_view> lines = linesOf(text);
        std::size_t next = 0;
        for (const Directive& directive : scanned->directives) {
            take(lines, next, static_cast<std::size_t>(directive.first) - 1);
            const bool stays = keeps(directive);
            if (stays) take(lines, next, static_cast<std::size_t>(directive.last));
            next = static_cast<std::size_t>(directive.last);
        }
        take(lines, next, lines.size());
        return std::move(result_);
    }

private:
    struct Conditional {
        bool decided = false;
        bool live = true;
    };

    [[nodiscard]] bool live() const { return std::ranges::all_of(open_, &Conditional::live); }

    void take(const std::vector<std::string_view>& lines, std::size_t& next, std::size_t end) {
        for (; next < end; ++next)
            if (live()) result_ += lines[next];
    }

    /// Follows the directive; whether it belongs into the result.
    bool keeps(const Directive& directive) {
        const auto known = known_.find(directive.argument());
        if (directive.opens()) {
            const bool decided = live() && !directive.is("if") && known != known_.end();
            const bool stays = live() && !decided;
            open_.push_back({decided, !decided || known->second == directive.is("ifdef")});
            return stays;
        }
        if (open_.empty() || !(directive.is("else") || directive.is("endif"))) {
            const bool guards = directive.is("define") && known != known_.end() && live();
            if (guards) known->second = true;
            return live() && !guards;
        }
        Conditional& last = open_.back();
        const bool decided = last.decided;
        if (directive.is("else") && decided) last.live = !last.live;
        if (directive.is("endif")) open_.pop_back();
        return !decided && live();
    }

    std::map<std::string, bool, std::less<>> known_;
    std::vector<Conditional> open_;
    std::string result_;
};

/// Without files of which comments alone are left, and without more than one empty line on end.
std::string tidied(const std::string& text) {
    std::string result;
    std::string part;
    bool code = true; // in the part; the first is the head
    const auto isBlank = [](std::string_view line) { return line.find_first_not_of(" \n") == std::string_view::npos; };
    for (const std::string_view line : linesOf(text)) {
        const bool begins = line.starts_with("// ---- begin ");
        if (begins) {
            result += code ? part : "";
            part = "\n";
            code = false;
        }
        if (line.starts_with("// ---- ") && !begins) continue; // where a file ends the next one begins
        if (isBlank(line) && part.ends_with("\n\n")) continue;
        part += line;
        code = code || !(isBlank(line) || line.starts_with("//"));
    }
    return result + (code ? part : "");
}

/// The first lines of comment, and what follows behind a guard.
std::string behindGuard(const std::string& text) {
    std::size_t head = 0;
    while (text.compare(head, 2, "//") == 0 && text.compare(head, 8, "// ---- ") != 0)
        head = std::min(text.find('\n', head), text.size() - 1) + 1;
    return fmt::format("{}#ifndef TEGUMENT_HLSL\n#define TEGUMENT_HLSL\n{}\n#endif\n", text.substr(0, head), text.substr(head));
}

constexpr std::array kEffectTargets = {"", "FX_D3D10", "FX_D3D11", "FX_ENTRY"};
constexpr std::array kLibraryTargets = {"", "TEGUMENT_HLSL_3"};

Error notMerged(const fs::path& file) {
    return inputError(3305, {.file = file.string()}, "the includes cannot be merged without changing what compilers read",
                      "does a file depend on its own name, or on __FILE__ or __LINE__?");
}

} // namespace

Result<std::string> flattenLibrary(const fs::path& file, const PreprocessOptions& options) {
    PreprocessOptions library = options;
    library.defines.emplace_back(kLibrary, "1");
    if (const auto original = tokensOf(file, library); !original) return original.error();
    Flattener flattener(options, file, true);
    const auto whole = flattener.run(file);
    if (!whole) return whole;
    const auto decided = Decided(kLibrary, flattener.guards()).run(*whole);
    if (!decided) return decided;
    std::string text = behindGuard(tidied(*decided));
    const auto faithful = isFaithful(file, options, text, kLibraryTargets, kLibrary);
    if (!faithful) return faithful.error();
    if (!*faithful) return notMerged(file);
    return text;
}

Result<std::string> flattenEffect(const fs::path& file, const PreprocessOptions& options) {
    if (const auto original = tokensOf(file, options); !original) return original.error();
    for (const bool mergeOnce : {true, false}) { // a file may undo its own guard to be read twice
        auto text = Flattener(options, file, mergeOnce).run(file);
        if (!text) return text;
        const auto faithful = isFaithful(file, options, *text, kEffectTargets);
        if (!faithful) return faithful.error();
        if (*faithful) return text;
    }
    return notMerged(file);
}

} // namespace tegument
