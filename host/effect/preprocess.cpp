#include "host/effect/preprocess.h"

#include "host/effect/condition.h"
#include "host/effect/macros.h"
#include "host/support/file.h"
#include "host/support/text.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tegument {

namespace {

namespace fs = std::filesystem;

constexpr int kDeepestInclude = 64;
constexpr std::size_t kMostBytes = 8u << 20; // of all files read for one effect, each inclusion counted; the largest effect has 100 KB
constexpr int kMostFiles = 4096;
constexpr int kOutside = 1014;

using Line = std::span<const Token>;

struct Conditional {
    Token opened;
    bool active = false; // its present group is read
    bool taken = false;  // one of its groups has been read
    bool inElse = false;
    bool outerActive = false;
};

class Preprocessor {
public:
    Preprocessor(const PreprocessOptions& options, Sources& sources) : options_(options), sources_(sources), macros_(sources) {}

    Result<Preprocessed> run(const fs::path& file) {
        std::string defines;
        for (const auto& [name, value] : options_.defines)
            defines += fmt::format("#define {} {}\n", name, value);
        const int commandLine = sources_.add("<defines>", std::make_shared<std::string>(defines));
        const Result<std::string> text = options_.read(file);
        if (!text) return text.error();
        const auto shared = std::make_shared<const std::string>(*text);
        texts_[file] = shared;
        if (process(commandLine, 0) && process(sources_.add(file.string(), shared), 0)) {
            describe();
            return std::move(result_);
        }
        return Error{Blame::Input, {*failure_}};
    }

private:
    /// What the effect says of its own switches. Neither macro is expanded anywhere: compilers never see them.
    void describe() {
        const std::vector<std::string> settings = macros_.words("FX_SETTINGS");
        if (settings.size() > 1) {
            result_.settings = EffectSettings{.define = settings[0], .names = {settings.begin() + 1, settings.end()}, .current = {}};
            const std::string value = valueOf(settings[0]);
            result_.settings->current = value;
            for (std::size_t i = 0; i < result_.settings->names.size(); ++i)
                if (value == std::to_string(i)) result_.settings->current = result_.settings->names[i];
        }
        const std::vector<std::string> metadata = macros_.words("FX_METADATA");
        for (std::size_t i = 0; i + 1 < metadata.size(); i += 2)
            result_.metadata[metadata[i]] = valueOf(metadata[i + 1]);
    }

    std::string valueOf(const std::string& name) const { return fmt::format("{}", fmt::join(macros_.words(name), " ")); }

    bool fail(int code, const Token& at, std::string text, std::string hint = {}) {
        failure_ =
            Diagnostic{.code = code, .at = sources_.position(at), .text = std::move(text), .hint = std::move(hint), .sourceLine = {}};
        return false;
    }

    void warn(int code, const Token& at, std::string text, std::string hint = {}) {
        result_.warnings.push_back({.severity = Severity::Warning,
                                    .code = code,
                                    .at = sources_.position(at),
                                    .text = std::move(text),
                                    .hint = std::move(hint),
                                    .sourceLine = {}});
    }

    bool process(int file, int depth) {
        bytes_ += sources_[file].text->size();
        LexResult lexed = lex(sources_, file);
        if (!lexed.errors.empty()) {
            failure_ = lexed.errors[0];
            return false;
        }
        std::vector<Conditional> conditionals;
        std::vector<Token> pending;
        const std::vector<Token>& tokens = lexed.tokens;
        for (std::size_t start = 0; start < tokens.size();) {
            const auto end = std::find_if(tokens.begin() + static_cast<std::ptrdiff_t>(start), tokens.end(),
                                          [](const Token& t) { return t.kind == TokenKind::Newline; });
            const Line line(tokens.data() + start, static_cast<std::size_t>(end - tokens.begin()) - start);
            start += line.size() + 1;
            const bool active = conditionals.empty() || conditionals.back().active;
            if (!line.empty() && line[0].is('#')) {
                const bool within = macros_.isOpenCall(pending) && !(line.size() > 1 && line[1].is("include"));
                if ((!within && !flush(pending)) || !directive(line, conditionals, depth)) return false;
            } else if (active) {
                pending.insert(pending.end(), line.begin(), line.end());
            }
        }
        if (!flush(pending)) return false;
        if (conditionals.empty()) return true;
        return fail(1008, conditionals.back().opened, "this conditional has no '#endif'");
    }

    bool flush(std::vector<Token>& pending) {
        for (const Token& token : pending)
            if (token.kind == TokenKind::BadString) return fail(1004, token, "this string is never closed");
        if (!macros_.expand(pending, result_.tokens)) {
            failure_ = macros_.failure();
            return false;
        }
        pending.clear();
        return true;
    }

    bool directive(Line line, std::vector<Conditional>& conditionals, int depth) {
        if (line.size() == 1) return true; // the null directive
        const std::string_view name = line[1].text;
        noticeDialect(line);
        if (name == "if" || name == "ifdef" || name == "ifndef") return openConditional(line, conditionals);
        if (name == "elif" || name == "else" || name == "endif") return continueConditional(line, conditionals);
        if (!conditionals.empty() && !conditionals.back().active) return true;
        if (name == "define") return define(line);
        if (name == "undef") return undefine(line);
        if (name == "include") return include(line, depth);
        if (name == "pragma") return pragma(line);
        if (name == "error") return fail(1007, line[1], fmt::format("#error {}", rest(line)));
        if (name == "line" || line[1].kind == TokenKind::Number) return true;
        static const std::array<std::string, 11> kNames{"if",     "ifdef", "ifndef",  "elif",   "else", "endif",
                                                        "define", "undef", "include", "pragma", "error"};
        return fail(1005, line[1], fmt::format("unknown directive '#{}'", name), didYouMean(name, kNames));
    }

    /// A file that asks which compiler reads it is written for this host.
    void noticeDialect(Line line) {
        const std::string_view name = line[1].text;
        if (name != "if" && name != "ifdef" && name != "ifndef" && name != "elif") return;
        for (const Token& token : line)
            for (const std::string_view macro : {"FX_ENTRY", "FX_D3D10", "FX_D3D11"})
                result_.ownDialect = result_.ownDialect || token.is(macro);
    }

    /// The text after the directive's name, as written.
    static std::string rest(Line line) {
        if (line.size() < 3) return {};
        const char* begin = line[2].text.data();
        const Token& last = line.back();
        return {begin, static_cast<std::size_t>(last.text.data() + last.text.size() - begin)};
    }

    bool openConditional(Line line, std::vector<Conditional>& conditionals) {
        const bool outer = conditionals.empty() || conditionals.back().active;
        bool holds = false;
        if (outer) {
            const std::optional<bool> value = condition(line);
            if (!value) return false;
            holds = *value;
        }
        conditionals.push_back({.opened = line[1], .active = holds, .taken = holds, .outerActive = outer});
        return true;
    }

    bool continueConditional(Line line, std::vector<Conditional>& conditionals) {
        const std::string_view name = line[1].text;
        if (conditionals.empty()) return fail(1008, line[1], fmt::format("'#{}' without '#if'", name));
        Conditional& open = conditionals.back();
        if (name == "endif") {
            conditionals.pop_back();
            return true;
        }
        if (open.inElse) return fail(1008, line[1], fmt::format("'#{}' after '#else'", name));
        open.inElse = name == "else";
        bool holds = open.outerActive && !open.taken;
        if (holds && name == "elif") {
            const std::optional<bool> value = condition(line);
            if (!value) return false;
            holds = *value;
        }
        open.active = holds;
        open.taken = open.taken || holds;
        return true;
    }

    std::optional<bool> condition(Line line) {
        if (line[1].text == "ifdef" || line[1].text == "ifndef") {
            if (line.size() >= 3 && line[2].kind == TokenKind::Word) return macros_.isDefined(line[2].text) == (line[1].text == "ifdef");
            fail(1006, line[1], fmt::format("'#{}' needs a name", line[1].text));
            return std::nullopt;
        }
        std::vector<Token> tokens;
        if (!replaceDefined(line, tokens)) return std::nullopt;
        std::vector<Token> expanded;
        if (!macros_.expand(tokens, expanded)) {
            failure_ = macros_.failure();
            return std::nullopt;
        }
        const auto value = evaluateCondition(expanded);
        if (const auto* error = std::get_if<ConditionError>(&value)) {
            fail(1006, error->token < expanded.size() ? expanded[error->token] : line[1],
                 fmt::format("#{}: {}", line[1].text, error->text));
            return std::nullopt;
        }
        return std::get<std::int64_t>(value) != 0;
    }

    /// `defined X` and `defined(X)` become 1 or 0 before macros are expanded.
    bool replaceDefined(Line line, std::vector<Token>& tokens) {
        for (std::size_t i = 2; i < line.size(); ++i) {
            if (!line[i].is("defined")) {
                tokens.push_back(line[i]);
                continue;
            }
            const bool bracket = i + 1 < line.size() && line[i + 1].is('(');
            const std::size_t name = i + (bracket ? 2 : 1);
            const bool closed = !bracket || (name + 1 < line.size() && line[name + 1].is(')'));
            if (name >= line.size() || line[name].kind != TokenKind::Word || !closed) return fail(1006, line[i], "'defined' needs a name");
            Token value = line[i];
            value.kind = TokenKind::Number;
            value.text = macros_.isDefined(line[name].text) ? "1" : "0";
            tokens.push_back(value);
            i = name + (bracket ? 1 : 0);
        }
        return true;
    }

    bool define(Line line) {
        if (line.size() < 3 || line[2].kind != TokenKind::Word) return fail(1006, line[1], "'#define' needs a name");
        Macro macro{.name = line[2]};
        std::size_t at = 3;
        if (at < line.size() && line[at].is('(') && !line[at].space) {
            macro.isFunction = true;
            if (!parameters(line, ++at, macro)) return false;
        }
        macro.body.assign(line.begin() + static_cast<std::ptrdiff_t>(at), line.end());
        const std::size_t n = macro.body.size();
        if (isPaste(macro.body, 0) || (n >= 2 && isPaste(macro.body, n - 2)))
            return fail(1010, macro.name, fmt::format("'##' at an end of macro '{}'", macro.name.text));
        for (const Token& token : macro.body)
            if (token.kind == TokenKind::BadString) return fail(1004, token, "this string is never closed");
        if (macros_.define(std::move(macro))) warn(1012, line[2], fmt::format("macro '{}' is defined again, differently", line[2].text));
        return true;
    }

    bool parameters(Line line, std::size_t& at, Macro& macro) {
        while (at < line.size() && !line[at].is(')')) {
            if (!macro.parameters.empty()) {
                if (!line[at].is(',')) break;
                ++at;
            }
            if (at == line.size() || line[at].kind != TokenKind::Word) break;
            macro.parameters.push_back(line[at++].text);
        }
        if (at < line.size() && line[at].is(')')) {
            ++at;
            return true;
        }
        return fail(1006, at < line.size() ? line[at] : line[2], fmt::format("bad parameter list of macro '{}'", macro.name.text),
                    "names between commas; variadic macros are not HLSL");
    }

    bool undefine(Line line) {
        if (line.size() < 3 || line[2].kind != TokenKind::Word) return fail(1006, line[1], "'#undef' needs a name");
        macros_.undefine(line[2].text);
        return true;
    }

    bool pragma(Line line) {
        if (line.size() >= 3 && line[2].is("once")) {
            once_.insert(sources_[line[0].file].name);
            return true;
        }
        result_.pragmas.push_back(
            {.before = result_.tokens.size(), .file = line[0].file, .line = line[0].line, .text = "#pragma " + rest(line)});
        return true;
    }

    std::optional<std::string> includeName(Line line) {
        std::vector<Token> tokens(line.begin() + 2, line.end());
        if (!tokens.empty() && tokens[0].kind == TokenKind::Word) {
            const std::vector<Token> unexpanded = std::exchange(tokens, {});
            if (!macros_.expand(unexpanded, tokens)) {
                failure_ = macros_.failure();
                return std::nullopt;
            }
        }
        if (!tokens.empty() && tokens[0].kind == TokenKind::String && tokens[0].text.size() > 2)
            return std::string(tokens[0].text.substr(1, tokens[0].text.size() - 2));
        if (tokens.size() > 2 && tokens[0].is('<')) {
            const std::string text = rest(line);
            if (const std::size_t close = text.find('>'); text.starts_with('<') && close != std::string::npos)
                return text.substr(1, close - 1);
        }
        fail(1006, line[1], "'#include' needs \"file\" or <file>");
        return std::nullopt;
    }

    bool include(Line line, int depth) {
        const std::optional<std::string> name = includeName(line);
        if (!name) return false;
        if (depth + 1 > kDeepestInclude)
            return fail(1002, line[1], fmt::format("includes are nested deeper than {}", kDeepestInclude),
                        fmt::format("does '{}' include itself without an include guard?", *name));
        if (sources_.size() > kMostFiles || bytes_ > kMostBytes)
            return fail(1011, line[1], fmt::format("more than {} inclusions or {} MiB of text", kMostFiles, kMostBytes >> 20));
        const Token& at = line.size() > 2 ? line[2] : line[1];
        std::vector<std::string> tried;
        outside_.reset();
        const std::optional<fs::path> path = find(*name, sources_[line[0].file].name, at, tried);
        if (!path && outside_) return fail(kOutside, at, outside_->text, outside_->hint);
        if (!path) {
            const auto folder = options_.search ? options_.search(*name) : std::nullopt;
            return fail(1001, at, fmt::format("cannot find include file '{}'", *name),
                        folder ? fmt::format("-I {} finds it", shellWord(folder->string()))
                               : fmt::format("looked for {}", fmt::join(tried, ", ")));
        }
        if (once_.contains(path->string())) return true;
        including_.push_back(fs::path(sources_[line[0].file].name).parent_path());
        const bool good = process(sources_.add(path->string(), texts_[*path]), depth + 1);
        including_.pop_back();
        return good;
    }

    /// Beside the including file, then beside each file on the way up to the effect, as Microsoft's handler looks, then the include
    /// folders.
    [[nodiscard]] std::vector<fs::path> foldersFrom(const std::string& from) const {
        std::vector<fs::path> folders{fs::path(from).parent_path()};
        const std::vector<fs::path> upwards(including_.rbegin(), including_.rend());
        for (const fs::path& folder : upwards)
            if (std::ranges::find(folders, folder) == folders.end()) folders.push_back(folder);
        folders.insert(folders.end(), options_.includeFolders.begin(), options_.includeFolders.end());
        return folders;
    }

    bool readable(const fs::path& path) {
        if (texts_.contains(path)) return true;
        const Result<std::string> text = options_.read(path);
        if (!text) {
            const Diagnostic& why = text.error().diagnostics.front();
            if (why.code == kOutside && !outside_) outside_ = why;
            return false;
        }
        texts_[path] = std::make_shared<const std::string>(*text);
        result_.includes.push_back(path);
        return true;
    }

    /// The first readable candidate; in another case than written only where no folder has it as written.
    std::optional<fs::path> find(const std::string& name, const std::string& from, const Token& at, std::vector<std::string>& tried) {
        std::string portable = name;
        std::ranges::replace(portable, '\\', '/');
        const std::vector<fs::path> folders = foldersFrom(from);
        for (const fs::path& folder : folders) {
            const fs::path path = (folder / portable).lexically_normal();
            if (readable(path)) return path;
            tried.push_back("'" + path.string() + "'");
        }
        if (!options_.anyCase) return std::nullopt;
        for (const fs::path& folder : folders) {
            const auto path = findInAnyCase(folder, portable);
            if (!path || !readable(*path)) continue;
            warn(1013, at, fmt::format("'{}' is spelt '{}' on disk", name, path->string()), "other systems tell cases apart");
            return path;
        }
        return std::nullopt;
    }

    const PreprocessOptions& options_;
    Sources& sources_;
    Macros macros_;
    Preprocessed result_;
    std::optional<Diagnostic> failure_;
    std::optional<Diagnostic> outside_; // the first candidate of an include that is there and may not be read
    std::map<fs::path, std::shared_ptr<const std::string>> texts_;
    std::set<std::string> once_;
    std::vector<fs::path> including_; // the folders of the files that include the present one, the effect first
    std::size_t bytes_ = 0;
};

} // namespace

FileReader confinedReader(const fs::path& effect, Roots roots) {
    // An effect is read in two views: both see what the first one read, also of a file that is written meanwhile, or of a pipe.
    const auto read = std::make_shared<std::map<fs::path, std::string>>();
    return [effect, read, roots = std::move(roots)](const fs::path& path) -> Result<std::string> {
        std::error_code code;
        if (const auto known = read->find(path); known != read->end()) return known->second;
        if (path == effect || !fs::exists(path, code) || roots.hold(path)) {
            auto text = readFile(path);
            if (text) read->emplace(path, *text);
            return text;
        }
        return Error{Blame::Input, {outsideOf(path, {.file = path.string(), .byte = {}})}};
    };
}

Result<Preprocessed> preprocess(const fs::path& file, const PreprocessOptions& options, Sources& sources) {
    return Preprocessor(options, sources).run(file);
}

} // namespace tegument
