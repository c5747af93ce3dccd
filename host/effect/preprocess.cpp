#include "host/effect/preprocess.h"

#include "host/effect/operators.h"
#include "host/support/file.h"
#include "host/support/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <string_view>
#include <variant>

namespace tegument {

namespace {

struct Macro {
    Token name;
    bool isFunction = false;
    std::vector<std::string_view> parameters;
    std::vector<Token> body;
    int active = 0; // expansions of it that are being rescanned

    [[nodiscard]] bool sameAs(const Macro& other) const;
};

class Macros {
public:
    explicit Macros(Sources& sources) : sources_(sources) {}

    [[nodiscard]] bool isDefined(std::string_view name) const { return table_.contains(name); }
    /// True if a different macro of that name was replaced.
    bool define(Macro macro);
    void undefine(std::string_view name);
    /// The words of a macro's body, as written; empty when there is no such macro.
    [[nodiscard]] std::vector<std::string> words(std::string_view name) const;

    /// Appends the expansion of `input`, which holds whole macro calls, to `output`. False: see `failure`.
    bool expand(std::span<const Token> input, std::vector<Token>& output);

    /// Whether the tokens end within the arguments of a macro's call, or on a name that can begin one.
    [[nodiscard]] bool isOpenCall(std::span<const Token> tokens) const;

    [[nodiscard]] const std::optional<Diagnostic>& failure() const { return failure_; }

private:
    struct Frame {
        std::vector<Token> tokens;
        std::size_t at = 0;
        Macro* macro = nullptr;
    };
    using Frames = std::vector<Frame>;
    using Arguments = std::vector<std::vector<Token>>;

    bool fail(int code, const Token& at, std::string text, std::string hint = {});
    bool tooMany(const Token& at);
    bool expandFrames(Frames& frames, std::vector<Token>& output);
    bool expandWord(Frames& frames, Token token, std::vector<Token>& output);
    std::optional<Token> next(Frames& frames);
    bool nextIsOpen(Frames& frames) const;
    bool push(Frames& frames, Macro& macro, std::vector<Token> tokens);
    std::optional<Arguments> collect(Frames& frames, const Macro& macro, const Token& call);
    std::optional<std::vector<Token>> substitute(const Macro& macro, const Arguments& arguments, const Token& call);
    void appendArgument(std::vector<Token>& result, const std::vector<Token>& argument, bool pasted);
    void paste(std::vector<Token>& result, const Token& right);
    [[nodiscard]] Token stringified(const std::vector<Token>& argument, const Token& call);
    [[nodiscard]] std::optional<Token> builtIn(const Token& name);

    Sources& sources_;
    std::map<std::string, Macro, std::less<>> table_;
    std::optional<Diagnostic> failure_;
    std::size_t produced_ = 0;
    int depth_ = 0;
    bool spaceNext_ = false;
};

/// Each doubling macro of a chain doubles the output; this many tokens is twenty times the largest effect.
constexpr std::size_t kMostTokens = 500'000;
/// Macro calls as arguments of macro calls; bounds our own recursion.
constexpr int kDeepestCall = 128;

void place(Token& token, const Token& at) {
    token.file = at.file;
    token.line = at.line;
    token.column = at.column;
}

std::size_t parameterIndex(const Macro& macro, const Token& token) {
    if (token.kind != TokenKind::Word) return macro.parameters.size();
    return static_cast<std::size_t>(std::ranges::find(macro.parameters, token.text) - macro.parameters.begin());
}

/// Whether `tokens[i]` and `tokens[i + 1]` are the operator `##`.
bool isPaste(std::span<const Token> tokens, std::size_t i) {
    return i + 1 < tokens.size() && tokens[i].is('#') && tokens[i + 1].is('#') && !tokens[i + 1].space;
}

bool Macro::sameAs(const Macro& other) const {
    const auto same = [](const Token& a, const Token& b) { return a.text == b.text && a.kind == b.kind; };
    return isFunction == other.isFunction && parameters == other.parameters && std::ranges::equal(body, other.body, same);
}

bool Macros::define(Macro macro) {
    const std::string name(macro.name.text);
    const auto old = table_.find(name);
    const bool replaced = old != table_.end() && !old->second.sameAs(macro);
    table_.insert_or_assign(name, std::move(macro));
    return replaced;
}

std::vector<std::string> Macros::words(std::string_view name) const {
    std::vector<std::string> words;
    if (const auto found = table_.find(name); found != table_.end())
        for (const Token& token : found->second.body)
            words.emplace_back(token.text);
    return words;
}

void Macros::undefine(std::string_view name) {
    if (const auto found = table_.find(name); found != table_.end()) table_.erase(found);
}

bool Macros::fail(int code, const Token& at, std::string text, std::string hint) {
    if (!failure_) failure_ = Diagnostic{.code = code, .at = sources_.position(at), .text = std::move(text), .hint = std::move(hint)};
    return false;
}

bool Macros::tooMany(const Token& at) {
    return fail(1011, at, fmt::format("macros expand to more than {} tokens", kMostTokens));
}

bool Macros::expand(std::span<const Token> input, std::vector<Token>& output) {
    if (input.empty()) return true;
    if (++depth_ > kDeepestCall) {
        --depth_;
        return fail(1011, input[0], fmt::format("macro calls are nested deeper than {}", kDeepestCall));
    }
    Frames frames;
    frames.push_back({{input.begin(), input.end()}, 0, nullptr});
    const bool good = expandFrames(frames, output);
    for (const Frame& frame : frames)
        if (frame.macro != nullptr) --frame.macro->active;
    --depth_;
    return good;
}

bool Macros::expandFrames(Frames& frames, std::vector<Token>& output) {
    while (const std::optional<Token> token = next(frames)) {
        if (token->kind == TokenKind::Word && !token->noExpand) {
            if (!expandWord(frames, *token, output)) return false;
        } else {
            output.push_back(*token);
        }
    }
    return true;
}

bool Macros::isOpenCall(std::span<const Token> tokens) const {
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const auto macro = tokens[i].kind == TokenKind::Word ? table_.find(tokens[i].text) : table_.end();
        if (macro == table_.end() || !macro->second.isFunction) continue;
        int depth = 0;
        std::size_t at = i + 1;
        for (; at < tokens.size(); ++at) {
            depth += tokens[at].is('(') ? 1 : tokens[at].is(')') ? -1 : 0;
            if (depth <= 0) break;
        }
        if (at == tokens.size()) return true;
        i = at;
    }
    return false;
}

std::optional<Token> Macros::builtIn(const Token& name) {
    Token token = name;
    if (name.text == "__LINE__") {
        token.kind = TokenKind::Number;
        token.text = sources_.keep(std::to_string(name.line));
        return token;
    }
    if (name.text == "__FILE__") {
        token.kind = TokenKind::String;
        token.text = sources_.keep('"' + sources_[name.file].name + '"');
        return token;
    }
    return std::nullopt;
}

bool Macros::expandWord(Frames& frames, Token token, std::vector<Token>& output) {
    const auto found = table_.find(token.text);
    if (found == table_.end()) {
        output.push_back(builtIn(token).value_or(token));
        return true;
    }
    Macro& macro = found->second;
    if (macro.active > 0) {
        token.noExpand = true;
        output.push_back(token);
        return true;
    }
    Arguments arguments;
    if (macro.isFunction) {
        if (!nextIsOpen(frames)) {
            output.push_back(token);
            return true;
        }
        std::optional<Arguments> collected = collect(frames, macro, token);
        if (!collected) return false;
        arguments = std::move(*collected);
    }
    std::optional<std::vector<Token>> result = substitute(macro, arguments, token);
    return result && push(frames, macro, std::move(*result));
}

bool Macros::push(Frames& frames, Macro& macro, std::vector<Token> tokens) {
    if (!tokens.empty()) tokens[0].space = true;
    ++macro.active;
    frames.push_back({std::move(tokens), 0, &macro});
    return true;
}

/// The next token of the innermost frame that has one; frames read to their end are left.
std::optional<Token> Macros::next(Frames& frames) {
    while (!frames.empty()) {
        Frame& frame = frames.back();
        if (frame.at < frame.tokens.size()) {
            Token token = frame.tokens[frame.at++];
            token.space = token.space || spaceNext_;
            spaceNext_ = false;
            return token;
        }
        if (frame.macro != nullptr) --frame.macro->active;
        frames.pop_back();
        spaceNext_ = true;
    }
    return std::nullopt;
}

bool Macros::nextIsOpen(Frames& frames) const {
    const auto unread = std::find_if(frames.rbegin(), frames.rend(), [](const Frame& frame) { return frame.at < frame.tokens.size(); });
    return unread != frames.rend() && unread->tokens[unread->at].is('(');
}

std::optional<Macros::Arguments> Macros::collect(Frames& frames, const Macro& macro, const Token& call) {
    Arguments arguments(1);
    next(frames); // the opening bracket
    for (int depth = 1; depth > 0;) {
        const std::optional<Token> token = next(frames);
        if (!token) {
            fail(1009, call, fmt::format("the call of macro '{}' is never closed", call.text));
            return std::nullopt;
        }
        depth += token->is('(') ? 1 : token->is(')') ? -1 : 0;
        if (depth == 1 && token->is(',')) {
            arguments.emplace_back();
        } else if (depth > 0) {
            arguments.back().push_back(*token);
        }
        if (++produced_ > kMostTokens) { // nested calls copy their arguments once for each level
            tooMany(call);
            return std::nullopt;
        }
    }
    if (macro.parameters.empty() && arguments.size() == 1 && arguments[0].empty()) arguments.clear();
    if (arguments.size() == macro.parameters.size()) return arguments;
    fail(1009, call, fmt::format("macro '{}' takes {} arguments, not {}", call.text, macro.parameters.size(), arguments.size()));
    return std::nullopt;
}

/// The texts side by side, read again: one token, several (`a##.##b`) or, of two strings, the two.
void Macros::paste(std::vector<Token>& result, const Token& right) {
    if (result.empty()) return result.push_back(right);
    const Token left = result.back();
    result.pop_back();
    const std::string_view text = sources_.keep(std::string(left.text) + std::string(right.text));
    std::vector<Token> tokens = tokensOf(sources_, text, left);
    if (!tokens.empty()) tokens.front().space = left.space;
    result.insert(result.end(), tokens.begin(), tokens.end());
}

void Macros::appendArgument(std::vector<Token>& result, const std::vector<Token>& argument, bool pasted) {
    for (std::size_t i = 0; i < argument.size(); ++i) {
        if (i == 0 && pasted) {
            paste(result, argument[0]);
            continue;
        }
        result.push_back(argument[i]);
        if (i == 0) result.back().space = true;
    }
}

Token Macros::stringified(const std::vector<Token>& argument, const Token& call) {
    std::string text = "\"";
    for (const Token& token : argument) {
        if (token.space && text.size() > 1) text += ' ';
        for (const char c : token.text) {
            if (token.kind == TokenKind::String && (c == '"' || c == '\\')) text += '\\';
            text += c;
        }
    }
    Token token = call;
    token.kind = TokenKind::String;
    token.text = sources_.keep(text + '"');
    return token;
}

std::optional<std::vector<Token>> Macros::substitute(const Macro& macro, const Arguments& arguments, const Token& call) {
    std::vector<Token> result;
    std::vector<std::optional<std::vector<Token>>> expanded(arguments.size());
    bool pasteNext = false;
    bool spaceAfter = false;
    for (std::size_t i = 0; i < macro.body.size(); ++i) {
        if (isPaste(macro.body, i)) {
            pasteNext = true;
            ++i;
            continue;
        }
        Token token = macro.body[i];
        place(token, call);
        token.space = token.space || spaceAfter;
        spaceAfter = false;
        const bool hash = macro.isFunction && token.is('#') && i + 1 < macro.body.size();
        if (hash && parameterIndex(macro, macro.body[i + 1]) < arguments.size()) {
            // Microsoft's compiler expands the argument first, C does not: the strings of an effect are what its own host sees.
            const std::size_t p = parameterIndex(macro, macro.body[++i]);
            if (!expanded[p] && !expand(arguments[p], expanded[p].emplace())) return std::nullopt;
            result.push_back(stringified(*expanded[p], call));
        } else if (const std::size_t p = parameterIndex(macro, token); p < arguments.size()) {
            const bool raw = pasteNext || isPaste(macro.body, i + 1);
            if (!raw && !expanded[p] && !expand(arguments[p], expanded[p].emplace())) return std::nullopt;
            appendArgument(result, raw ? arguments[p] : *expanded[p], pasteNext);
            spaceAfter = true;
        } else if (!pasteNext) {
            result.push_back(token);
        } else {
            paste(result, token);
        }
        pasteNext = false;
        if (produced_ + result.size() > kMostTokens) {
            tooMany(call);
            return std::nullopt;
        }
    }
    produced_ += result.size();
    return result;
}

struct ConditionError {
    std::size_t token = 0; // index into the tokens, or their count for "at the end"
    std::string text;
};

using Unsigned = std::uint64_t;

std::int64_t shifted(std::int64_t a, std::int64_t by, bool left) {
    if (by < 0 || by > 63) return 0;
    return left ? static_cast<std::int64_t>(static_cast<Unsigned>(a) << by) : a >> by;
}

std::int64_t arithmetic(char op, std::int64_t a, std::int64_t b) {
    const auto ua = static_cast<Unsigned>(a);
    const auto ub = static_cast<Unsigned>(b);
    switch (op) {
    case '+': return static_cast<std::int64_t>(ua + ub);
    case '-': return static_cast<std::int64_t>(ua - ub);
    case '*': return static_cast<std::int64_t>(ua * ub);
    case '|': return a | b;
    case '^': return a ^ b;
    case '&': return a & b;
    case '/': return b == -1 ? static_cast<std::int64_t>(0 - ua) : a / b;
    default: return b == -1 ? 0 : a % b;
    }
}

std::int64_t apply(std::string_view op, std::int64_t a, std::int64_t b) {
    if (const auto is = truth(op, a, b)) return *is ? 1 : 0;
    if (op == "<<" || op == ">>") return shifted(a, b, op == "<<");
    return arithmetic(op[0], a, b);
}

class Evaluator {
public:
    explicit Evaluator(std::span<const Token> tokens) : tokens_(tokens) {}

    std::variant<std::int64_t, ConditionError> run() {
        const std::int64_t value = ternary(true);
        if (!error_ && at_ < tokens_.size()) fail(fmt::format("'{}' does not belong to this expression", tokens_[at_].text));
        if (error_) return *error_;
        return value;
    }

private:
    std::int64_t fail(std::string text) {
        if (!error_) error_ = ConditionError{at_, std::move(text)};
        at_ = tokens_.size();
        return 0;
    }

    [[nodiscard]] bool is(std::string_view sign) const {
        if (at_ + sign.size() > tokens_.size()) return false;
        for (std::size_t i = 0; i < sign.size(); ++i)
            if (!tokens_[at_ + i].is(sign[i]) || (i > 0 && tokens_[at_ + i].space)) return false;
        return true;
    }

    bool accept(std::string_view sign) {
        if (!is(sign)) return false;
        at_ += sign.size();
        return true;
    }

    [[nodiscard]] const Operator* binaryOperator() const {
        for (const Operator& op : kOperators)
            if (is(op.text)) return &op;
        return nullptr;
    }

    /// `evaluated` is false in the branch that && || ?: do not take: a division by zero is no error there.
    std::int64_t ternary(bool evaluated) {
        if (++depth_ > kDeepestExpression) return fail(fmt::format("the expression is nested deeper than {}", kDeepestExpression));
        const std::int64_t condition = binary(1, evaluated);
        std::int64_t value = condition;
        if (accept("?")) {
            const std::int64_t a = ternary(evaluated && condition != 0);
            if (!accept(":")) return fail("':' expected after '?'");
            const std::int64_t b = ternary(evaluated && condition == 0);
            value = condition != 0 ? a : b;
        }
        --depth_;
        return value;
    }

    std::int64_t binary(int least, bool evaluated) {
        std::int64_t a = unary(evaluated);
        for (const Operator* op = binaryOperator(); op != nullptr && op->precedence >= least && !error_; op = binaryOperator()) {
            at_ += op->text.size();
            const bool skips = (op->text == "||" && a != 0) || (op->text == "&&" && a == 0);
            const std::int64_t b = binary(op->precedence + 1, evaluated && !skips);
            if ((op->text == "/" || op->text == "%") && b == 0) {
                if (evaluated) return fail("division by zero");
                a = 0;
            } else {
                a = apply(op->text, a, b);
            }
        }
        return a;
    }

    std::int64_t unary(bool evaluated) {
        std::string signs;
        while (at_ < tokens_.size() && (is("!") || is("-") || is("+") || is("~")))
            signs += tokens_[at_++].text[0];
        std::int64_t value = primary(evaluated);
        std::ranges::reverse(signs);
        for (const char sign : signs) {
            if (sign == '!') value = value == 0;
            if (sign == '-') value = arithmetic('-', 0, value);
            if (sign == '~') value = ~value;
        }
        return value;
    }

    std::int64_t primary(bool evaluated) {
        if (at_ == tokens_.size()) return fail("a value is missing");
        const Token& token = tokens_[at_];
        if (accept("(")) {
            const std::int64_t value = ternary(evaluated);
            if (!error_ && !accept(")")) return fail("')' expected");
            return value;
        }
        if (token.kind == TokenKind::Number) return number(token.text);
        if (token.kind == TokenKind::Word) {
            ++at_;
            return 0;
        }
        return fail(fmt::format("'{}' is not an integer", token.text));
    }

    std::int64_t number(std::string_view text) {
        const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
        std::string_view digits = hexadecimal ? text.substr(2) : text;
        while (!digits.empty() && std::string_view("uUlL").find(digits.back()) != std::string_view::npos)
            digits.remove_suffix(1);
        const int base = hexadecimal ? 16 : digits.size() > 1 && digits[0] == '0' ? 8 : 10;
        Unsigned value = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
        if (error != std::errc() || end != digits.data() + digits.size()) return fail(fmt::format("'{}' is not an integer", text));
        ++at_;
        return static_cast<std::int64_t>(value);
    }

    std::span<const Token> tokens_;
    std::size_t at_ = 0;
    int depth_ = 0;
    std::optional<ConditionError> error_;
};

/// Integer arithmetic of 64 bits that wraps; names left over after macro expansion are 0; `defined` is already replaced.
std::variant<std::int64_t, ConditionError> evaluateCondition(std::span<const Token> tokens) {
    return Evaluator(tokens).run();
}

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
        return Error{blame_, {*failure_}};
    }

private:
    /// What the effect says of its own switches. Neither macro is expanded anywhere: compilers never see them.
    void describe() {
        const std::vector<std::string> settings = macros_.words("FX_SETTINGS");
        if (settings.size() > 1) {
            result_.settings = EffectSettings{.define = settings[0], .names = {settings.begin() + 1, settings.end()}};
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
        failure_ = Diagnostic{.code = code, .at = sources_.position(at), .text = std::move(text), .hint = std::move(hint)};
        return false;
    }

    void warn(int code, const Token& at, std::string text, std::string hint = {}) {
        result_.warnings.push_back(inputWarning(code, sources_.position(at), std::move(text), std::move(hint)));
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
            if (line[i].is("exists") && i + 1 < line.size() &&
                line[i + 1].kind == TokenKind::String) { // ReShade's: whether a file is there
                std::vector<std::string> tried;
                Token value = line[i];
                value.kind = TokenKind::Number;
                value.text =
                    find(std::string(line[i + 1].text.substr(1, line[i + 1].text.size() - 2)), sources_[line[0].file].name, line[i], tried)
                        ? "1"
                        : "0";
                tokens.push_back(value);
                ++i;
                continue;
            }
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
        unread_.reset();
        const std::optional<fs::path> path = find(*name, sources_[line[0].file].name, at, tried);
        if (!path && unread_) return failAsRead(at);
        if (!path) {
            const auto folder = options_.search ? options_.search(*name) : std::nullopt;
            const bool theirs = toLower(fs::path(*name).filename().string()).starts_with("reshade");
            return fail(1001, at, fmt::format("cannot find include file '{}'", *name),
                        folder   ? fmt::format("-I {} finds it", shellWord(folder->string()))
                        : theirs ? std::string("it comes with crosire/reshade-shaders (GitHub): -I names its folder Shaders")
                                 : fmt::format("looked for {}", fmt::join(tried, ", ")));
        }
        if (once_.contains(path->string())) return true;
        including_.push_back(fs::path(sources_[line[0].file].name).parent_path());
        const bool good = process(sources_.add(path->string(), texts_[*path]), depth + 1);
        including_.pop_back();
        return good;
    }

    /// Why a candidate that is there was not read, at the place that includes it; a file's own message names the file.
    bool failAsRead(const Token& at) {
        const Diagnostic& why = unread_->diagnostics.front();
        blame_ = unread_->blame;
        const bool named = why.at.file.empty() || why.code == kOutside;
        return fail(why.code, at, named ? why.text : fmt::format("include file '{}' {}", why.at.file, why.text), why.hint);
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
            std::error_code code;
            const bool there = fs::exists(path, code) && !fs::is_directory(path, code);
            if (!unread_ && (there || text.error().blame == Blame::Machine)) unread_ = text.error();
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
    std::optional<Error> unread_; // of the first candidate of an include that is there and could not be read, or may not be
    Blame blame_ = Blame::Input;
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
        return Error{Blame::Input, {outsideOf(path, {.file = path.string()})}};
    };
}

Result<Preprocessed> preprocess(const fs::path& file, const PreprocessOptions& options, Sources& sources) {
    return Preprocessor(options, sources).run(file);
}

} // namespace tegument
