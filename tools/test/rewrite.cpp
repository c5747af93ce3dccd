#include "tools/test/rewrite.h"

#include "host/effect/parser.h"
#include "host/support/text.h"
#include "meshprep/adopt/spelling.h"
#include "tools/test/declarations.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace tegument::testing {

namespace {

struct AssertionKind {
    std::string_view name;
    SiteKind kind;
    std::size_t values;   // arguments that are compared
    bool limited = false; // tolerances behind them
};

constexpr AssertionKind kAssertionKinds[] = {
    {"tgEqual", SiteKind::Equal, 2},           {"tgNear", SiteKind::Near, 2, true},       {"tgTrue", SiteKind::True, 1},
    {"tgFinite", SiteKind::Finite, 1},         {"tgBetween", SiteKind::Between, 3},       {"tgIncreasing", SiteKind::Increasing, 1},
    {"tgDecreasing", SiteKind::Decreasing, 1}, {"tgContinuous", SiteKind::Continuous, 2}, {"tgWatch", SiteKind::Watch, 1}};

/// Operators and functions, and what a mutant has in their place.
constexpr std::string_view kOpposites[][2] = {{"+", "-"},        {"-", "+"},        {"*", "/"},       {"/", "*"},     {"<", ">"},
                                              {">", "<"},        {"min", "max"},    {"max", "min"},   {"sin", "cos"}, {"cos", "sin"},
                                              {"floor", "ceil"}, {"ceil", "floor"}, {"any", "all"},   {"all", "any"}, {"saturate", ""},
                                              {"abs", ""},       {"sqrt", ""},      {"normalize", ""}};

bool isDeclarationOfData(std::string_view word) {
    return word == "struct" || word == "class" || word == "interface" || word == "namespace" || word == "cbuffer" || word == "tbuffer";
}

/// Words that stand before a name without being its type.
bool isNoType(std::string_view word) {
    return word == "return" || word == "else" || word == "case" || word == "in" || word == "out" || word == "inout" || word == "do";
}

bool isResource(std::string_view type) {
    for (const std::string_view start : {"Texture", "texture", "Sampler", "sampler", "RW", "Structured", "Buffer", "ByteAddress"})
        if (type.starts_with(start)) return true;
    return false;
}

class Rewriter {
public:
    Rewriter(const Preprocessed& view, Sources& sources, const Roots& roots, const ReadOptions& options, TestFile& file)
        : view_(view), tokens_(view.tokens), sources_(sources), options_(options), file_(file), reader_{sources, roots, file} {}

    Rewritten run() {
        closing_ = matched();
        blanked_ = blanks();
        declarations(0, tokens_.size(), false);
        copyPragmas(tokens_.size());
        for (Test& test : file_.tests)
            test.fixtures.insert(test.fixtures.begin(), shared_.begin(), shared_.end());
        std::string counters;
        for (std::size_t i = 0; i < loopCount_; ++i)
            counters += fmt::format("static uint tgTestTurns{} = 0u;\n", i);
        return {.view = std::move(out_), .counters = std::move(counters), .effect = std::move(effect_)};
    }

private:
    [[noreturn]] void fail(int code, const Token& at, std::string text, std::string hint = {}) const {
        throw inputError(code, sources_.position(at), std::move(text), std::move(hint));
    }

    [[nodiscard]] bool is(std::size_t i, char sign) const { return i < tokens_.size() && tokens_[i].is(sign); }
    [[nodiscard]] bool isWord(std::size_t i) const { return i < tokens_.size() && tokens_[i].kind == TokenKind::Word; }
    [[nodiscard]] bool calls(std::size_t i, std::string_view name) const { return tokens_[i].is(name) && is(i + 1, '('); }

    /// Of each opening bracket its partner.
    [[nodiscard]] std::vector<std::size_t> matched() const {
        std::vector<std::size_t> closing(tokens_.size(), 0);
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            if (is(i, '(') || is(i, '[') || is(i, '{')) open.push_back(i);
            if (!is(i, ')') && !is(i, ']') && !is(i, '}')) continue;
            constexpr std::string_view kPairs = "()[]{}";
            if (open.empty() || kPairs[kPairs.find(tokens_[open.back()].text[0]) + 1] != tokens_[i].text[0])
                fail(8202, tokens_[i], fmt::format("this '{}' closes nothing", tokens_[i].text));
            closing[open.back()] = i;
            open.pop_back();
        }
        if (!open.empty()) fail(8202, tokens_[open.back()], fmt::format("this '{}' is not closed", tokens_[open.back()].text));
        return closing;
    }

    /// What only effects have, where this is one.
    [[nodiscard]] std::vector<bool> blanks() {
        std::vector<bool> blanked(tokens_.size(), false);
        const auto ofEffects = [](const Token& token) {
            return token.is("technique") || token.is("technique10") || token.is("technique11") || token.is("sampler_state");
        };
        const bool old = isOfDirect3D9();
        if (!old && std::ranges::none_of(tokens_, ofEffects)) return blanked;
        // Tests are no functions to the parser of effects, and fixtures no declarations.
        std::vector<Token> plain;
        std::vector<std::size_t> from;
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            if (testKind(i) || (isFixture(tokens_[i].text) && is(i + 1, '('))) {
                i = closing_[i + 1];
                if (is(i + 1, '{')) i = closing_[i + 1];
                if (is(i + 1, ';')) ++i;
                continue;
            }
            plain.push_back(tokens_[i]);
            from.push_back(i);
        }
        Parsed parsed = Parser(sources_, plain, true).run();
        for (const TokenRange& range : parsed.blanks)
            for (std::size_t i = range.first; i < range.last; ++i)
                blanked[from[i]] = true;
        if (old) effect_ = std::move(parsed.effect);
        return blanked;
    }

    /// Types and functions that later compilers do not have: `texture`, `tex2D`.
    [[nodiscard]] bool isOfDirect3D9() const {
        for (std::size_t i = 0; i + 1 < tokens_.size(); ++i)
            if ((adopt::isTexture9(tokens_[i].text) && isWord(i + 1)) || (adopt::fetchOf(tokens_[i].text) && is(i + 1, '('))) return true;
        return false;
    }

    void copyPragmas(std::size_t before) {
        for (; pragma_ < view_.pragmas.size() && view_.pragmas[pragma_].before <= before; ++pragma_) {
            out_.pragmas.push_back(view_.pragmas[pragma_]);
            out_.pragmas.back().before = out_.tokens.size();
        }
    }

    void copy(std::size_t i) {
        copyPragmas(i);
        if (!blanked_[i]) out_.tokens.push_back(tokens_[i]);
    }

    void copy(std::size_t first, std::size_t last) {
        for (; first < last; ++first)
            copy(first);
    }

    /// Text in place of a token, or behind it. Its index, for text that is known later.
    std::size_t emit(std::string text, const Token& at) {
        Token made = at;
        made.kind = TokenKind::Word;
        made.space = true;
        made.text = sources_.keep(std::move(text));
        out_.tokens.push_back(made);
        return out_.tokens.size() - 1;
    }

    std::uint32_t site(SiteKind kind, std::size_t first, std::size_t last) {
        file_.sites.push_back({.kind = kind, .at = sources_.position(tokens_[first]), .text = textOf(tokens_, first, last), .line = {}});
        return static_cast<std::uint32_t>(file_.sites.size() - 1);
    }

    [[nodiscard]] std::optional<std::string_view> testKind(std::size_t i) const {
        for (const std::string_view kind : {"TG_TEST", "TG_PIXEL_TEST", "TG_GROUP_TEST"})
            if (calls(i, kind)) return kind;
        return {};
    }

    void declarations(std::size_t first, std::size_t last, bool inside) {
        std::size_t head = first;
        for (std::size_t i = first; i < last;) {
            if (testKind(i)) {
                i = test(i);
                head = i;
            } else if (i == head && isFixture(tokens_[i].text) && is(i + 1, '(')) {
                shared_.push_back(fixture(i));
                i = behindStatement(i);
                head = i;
            } else if (is(i, '{')) {
                i = braces(head, i);
                if (!is(i, ';') && !is(i, ',') && !(isData(head) && hasName(head))) head = i;
            } else {
                const bool ends = is(i, ';');
                copy(i++);
                if (!ends) continue;
                if (!inside) declared(head, i);
                head = i;
            }
        }
    }

    [[nodiscard]] bool isData(std::size_t head) const { return isWord(head) && isDeclarationOfData(tokens_[head].text); }
    /// Behind whose braces names may stand.
    [[nodiscard]] bool hasName(std::size_t head) const { return tokens_[head].is("struct") || tokens_[head].is("class"); }

    /// Behind the closing one.
    std::size_t braces(std::size_t head, std::size_t open) {
        const std::size_t close = closing_[open];
        const bool semantic = open > head + 2 && isWord(open - 1) && is(open - 2, ':');
        if (isData(head)) {
            copy(open);
            declarations(open + 1, close, !tokens_[head].is("namespace"));
            copy(close);
            if (!hasName(head)) noteNames(open + 1, close, arrays_);
        } else if (open > head && (is(open - 1, ')') || semantic) && !blanked_[open] && !tokens_[head].text.starts_with("technique")) {
            function(head, open);
        } else {
            mutable_(head, close);
            copy(open, close + 1);
        }
        return close + 1;
    }

    /// A declaration of the file, its semicolon included.
    void declared(std::size_t first, std::size_t last) {
        noteNames(first, last, arrays_);
        mutable_(first, last);
        for (std::size_t i = first; i + 4 < last; ++i)
            if ((tokens_[i].is("StructuredBuffer") || tokens_[i].is("RWStructuredBuffer")) && is(i + 1, '<') && is(i + 3, '>')) {
                const std::string name(tokens_[i + 4].text);
                file_.elements[name] = tokens_[i + 2].text;
                arrays_[name] = fmt::format("tgTestSize_{}()", name);
                emit(fmt::format("uint tgTestSize_{0}() {{ uint count; uint stride; {0}.GetDimensions(count, stride); return count; }}",
                                 name),
                     tokens_[last - 1]);
            }
        if (auto given = reader_.defaultOf(tokens_, closing_, first, last)) shared_.push_back(std::move(*given));
    }

    /// Names that are declared, with the number of elements; empty: it is no array.
    void noteNames(std::size_t first, std::size_t last, std::map<std::string, std::string>& names) const {
        for (std::size_t i = first; i + 2 < last; ++i) {
            if (!isWord(i) || !isWord(i + 1) || isNoType(tokens_[i].text) || isResource(tokens_[i].text)) continue;
            const bool array = is(i + 2, '[') && closing_[i + 2] > i + 3 && !is(closing_[i + 2] + 1, '[');
            names[std::string(tokens_[i + 1].text)] = array ? textOf(tokens_, i + 3, closing_[i + 2]) : "";
        }
    }

    std::size_t test(std::size_t i) {
        const std::string_view kind = *testKind(i);
        const std::size_t close = closing_[i + 1];
        if (!isWord(i + 2) || !is(close + 1, '{'))
            fail(8202, tokens_[i], fmt::format("{} needs a name and a body", kind), fmt::format("{}(name) {{ ... }}", kind));
        Test made{.name = std::string(tokens_[i + 2].text), .at = sources_.position(tokens_[i])};
        made.entry = "tgTestRun_" + made.name;
        if (kind == "TG_PIXEL_TEST") made.stage = ShaderStage::Pixel;
        if (kind == "TG_GROUP_TEST") made.group = reader_.groupOf(tokens_, i, close);
        if (kind != "TG_GROUP_TEST" && close != i + 3) fail(8202, tokens_[i + 3], fmt::format("{} takes a name alone", kind));
        emit(fmt::format("void tgTest_{}()", made.name), tokens_[i]);
        test_ = &made;
        reader_.start(made);
        function(i, close + 1);
        test_ = nullptr;
        if (const auto error = reader_.finish(made)) throw Error(*error);
        if (made.neighbours && (made.row < 2 || made.invocations() > 1 || made.stage != ShaderStage::Compute))
            fail(8202, tokens_[i], fmt::format("{} compares neighbouring cases", made.name),
                 "write a TG_TEST whose first input is tgRange(low, high, count), tgCases(values) or tgTable(\"file\", column)");
        file_.tests.push_back(std::move(made));
        return closing_[close + 1] + 1;
    }

    void function(std::size_t head, std::size_t open) {
        locals_ = arrays_;
        floats_.clear();
        if (test_ == nullptr) noteNames(head, open, locals_);
        std::size_t name = head;
        while (name < open && (!isWord(name) || !is(name + 1, '(')))
            ++name;
        returns_ = name > head && name < open && test_ == nullptr ? std::string(tokens_[name - 1].text) : "void";
        if (test_ == nullptr) mutable_(open, closing_[open]);
        copy(open);
        loops_.push_back({});
        const std::size_t start = emit("", tokens_[open]);
        for (std::size_t i = open + 1; i < closing_[open];)
            i = statement(i);
        setStart(start, "");
        copy(closing_[open]);
    }

    /// What stands at the start of a function or of a loop's body: those directly in it begin to count anew.
    void setStart(std::size_t token, std::string text) {
        for (const std::size_t loop : loops_.back())
            text += fmt::format("tgTestTurns{} = 0u; ", loop);
        loops_.pop_back();
        out_.tokens[token].text = sources_.keep(std::move(text));
    }

    /// Behind the semicolon, which may be missing at the end of a block: the compiler says so.
    [[nodiscard]] Fixture fixture(std::size_t i) const {
        const std::size_t end = closing_[i + 1];
        if (!is(end + 1, ';')) fail(8203, tokens_[end], "a fixture ends with a semicolon", "write ';' behind this");
        return reader_.fixture(tokens_, closing_, i);
    }

    [[nodiscard]] std::size_t behindStatement(std::size_t i) const {
        while (i < tokens_.size() && !is(i, ';') && !is(i, '}'))
            i = is(i, '(') || is(i, '[') || is(i, '{') ? closing_[i] + 1 : i + 1;
        return is(i, ';') ? i + 1 : i;
    }

    /// Each returns the index behind what it has copied.
    std::size_t statement(std::size_t i, bool attributed = false, bool unrolled = false) {
        const Token& token = tokens_[i];
        const bool label = token.is("case") || (token.is("default") && is(i + 1, ':'));
        if (!attributed && !label && !is(i, '{') && !is(i, ';')) reached(i);
        if (is(i, '{')) return block(i);
        if (is(i, '[')) {
            const std::size_t close = closing_[i];
            copy(i, close + 1);
            return statement(close + 1, true, unrolled || tokens_[i + 1].is("unroll"));
        }
        if (token.is("if") && is(i + 1, '(')) return branch(i);
        if (token.is("switch") && is(i + 1, '(')) return body(head(i));
        if (token.is("for") && is(i + 1, '(')) return loop(i, head(i), unrolled);
        if (token.is("while") && is(i + 1, '(')) return loop(i, head(i), false);
        if (token.is("do")) {
            copy(i);
            const std::size_t end = behindStatement(loop(i, i + 1, false));
            return end;
        }
        if (!label) return simple(i);
        std::size_t colon = i;
        while (colon < tokens_.size() && !is(colon, ':') && !is(colon, '}'))
            ++colon;
        copy(i, colon + 1);
        return colon + 1;
    }

    void reached(std::size_t i) {
        if (!options_.coverage || test_ != nullptr) return;
        emit(counted(i), tokens_[i]);
    }

    [[nodiscard]] bool countsSides() const { return options_.coverage && test_ == nullptr; }

    /// Code that counts a statement, or a side of a branch.
    std::string counted(std::size_t i, int side = -1) {
        file_.counted.push_back({.at = sources_.position(tokens_[i]), .side = side});
        return fmt::format("tgTestReached({}u);", file_.counted.size() - 1);
    }

    std::size_t block(std::size_t open) {
        copy(open);
        for (std::size_t i = open + 1; i < closing_[open];)
            i = statement(i);
        copy(closing_[open]);
        return closing_[open] + 1;
    }

    /// `word ( ... )`
    std::size_t head(std::size_t word) {
        const std::size_t close = closing_[word + 1];
        copy(word, word + 2);
        noteNames(word + 2, close, locals_);
        expression(word + 2, close);
        copy(close);
        return close + 1;
    }

    /// A statement that may need braces around what is put before it, as the count of a side.
    std::size_t body(std::size_t i, const std::string& count = {}) {
        if (is(i, '{') && count.empty()) return block(i);
        emit("{ " + count, tokens_[i]);
        const std::size_t end = statement(i);
        emit("}", tokens_[end - 1]);
        return end;
    }

    std::size_t branch(std::size_t i) {
        const auto side = [&](int number) { return countsSides() ? counted(i, number) : std::string(); };
        const std::size_t first = head(i);
        const std::size_t end = body(first, side(0));
        const bool other = end < tokens_.size() && tokens_[end].is("else");
        if (other) copy(end);
        if (other) return body(end + 1, side(1));
        if (countsSides()) emit(fmt::format("else {{ {} }}", side(1)), tokens_[end - 1]);
        return end;
    }

    std::size_t loop(std::size_t word, std::size_t i, bool unrolled) {
        loops_.emplace_back();
        const bool braced = is(i, '{');
        if (braced) copy(i);
        const std::size_t start = emit("", tokens_[i]);
        std::size_t end = braced ? closing_[i] + 1 : i;
        for (std::size_t at = i + 1; braced && at < closing_[i];)
            at = statement(at);
        if (!braced) end = statement(i);
        std::string text = braced ? "" : "{ ";
        if (countsSides()) text += counted(word, 0) + " ";
        if (unrolled) {
            setStart(start, text);
        } else {
            setStart(start, fmt::format("{}if (tgTestLoop(tgTestTurns{}, {}u)) break; ", text, loopCount_, site(SiteKind::Loop, word, i)));
            loops_.back().push_back(loopCount_++);
        }
        if (braced)
            copy(closing_[i]);
        else
            emit("}", tokens_[end - 1]);
        if (tokens_[word].is("do")) { // while (...);
            const std::size_t last = behindStatement(end);
            expression(end, last);
            if (countsSides()) emit(counted(word, 1), tokens_[last - 1]);
        } else if (countsSides()) {
            emit(counted(word, 1), tokens_[end - 1]);
        }
        return end;
    }

    std::size_t simple(std::size_t i) {
        const std::size_t end = behindStatement(i);
        const std::size_t semicolon = is(end - 1, ';') ? end - 1 : end;
        if (isFixture(tokens_[i].text) && is(i + 1, '(')) {
            if (test_ == nullptr) fail(8203, tokens_[i], "a fixture stands in a test, or outside of functions");
            test_->fixtures.push_back(fixture(i));
            return end;
        }
        if (calls(i, "tgExpectFailure")) {
            if (test_ == nullptr) fail(8202, tokens_[i], "tgExpectFailure stands in a test");
            test_->why = unquoted(textOf(tokens_, i + 2, closing_[i + 1]));
            return end;
        }
        if (const auto input = reader_.input(tokens_, closing_, i, end, test_ != nullptr)) {
            const std::uint32_t number = site(SiteKind::Input, input->name, input->name + 1);
            emit(fmt::format("{} tgTestNote({}u, tgTestOf({}));", input->code, number, tokens_[input->name].text), tokens_[i]);
            trace(std::string(tokens_[input->name].text), input->name, end);
            return end;
        }
        noteNames(i, end, locals_);
        if (tokens_[i].is("return") && options_.trace && isFloat(returns_) && semicolon > i + 1) {
            emit(fmt::format("return tgTestTrace(({})(", returns_), tokens_[i]);
            expression(i + 1, semicolon);
            emit(fmt::format("), {}u)", site(SiteKind::NotANumber, i, semicolon)), tokens_[semicolon - 1]);
        } else {
            expression(i, semicolon);
        }
        copy(semicolon, end);
        traceAssigned(i, semicolon);
        return end;
    }

    static bool isFloat(std::string_view type) { return type == "float" || type == "float2" || type == "float3" || type == "float4"; }

    void trace(const std::string& name, std::size_t first, std::size_t last) {
        if (!options_.trace) return;
        emit(fmt::format("tgTestNan({}u, tgTestOf({}));", site(SiteKind::NotANumber, first, last), name), tokens_[last - 1]);
    }

    void traceAssigned(std::size_t first, std::size_t last) {
        if (!options_.trace) return;
        std::size_t name = first;
        while (name < last && (tokens_[name].is("const") || tokens_[name].is("static")))
            ++name;
        const bool declares = isWord(name) && isFloat(tokens_[name].text) && isWord(name + 1);
        if (declares) floats_.insert(std::string(tokens_[++name].text));
        bool assigns = false;
        for (std::size_t i = name + 1; i < last; ++i)
            assigns = assigns || (is(i, '=') && !is(i + 1, '=') && !is(i - 1, '='));
        if (declares && is(name + 1, '[')) floats_.erase(std::string(tokens_[name].text));
        if (const std::string text(tokens_[name].text); assigns && floats_.contains(text)) trace(text, first, last);
    }

    /// Of a `?` whose condition begins here; 0: there is none.
    [[nodiscard]] std::size_t questionOf(std::size_t i, std::size_t first, std::size_t last) const {
        const auto assigns = [&](std::size_t at) {
            return is(at, '=') && !is(at + 1, '=') && std::string_view("=!<>").find(tokens_[at - 1].text[0]) == std::string_view::npos;
        };
        const bool begins = i == first || is(i - 1, '(') || is(i - 1, '[') || is(i - 1, '{') || is(i - 1, ',') || is(i - 1, '?') ||
                            is(i - 1, ':') || is(i - 1, ';') || tokens_[i - 1].is("return") || assigns(i - 1);
        if (!countsSides() || tokens_[i].is("return") || !begins) return 0;
        for (std::size_t at = i; at < last && std::string_view(")]},;:").find(tokens_[at].text[0]) == std::string_view::npos; ++at) {
            if (is(at, '?')) return at;
            if (is(at, '(') || is(at, '[') || is(at, '{')) at = closing_[at];
            if (at > first && assigns(at)) return 0;
        }
        return 0;
    }

    void expression(std::size_t first, std::size_t last) {
        std::set<std::size_t> questions;
        for (std::size_t i = first; i < last;) {
            if (const std::size_t question = questionOf(i, first, last); question != 0 && questions.insert(question).second) {
                emit(fmt::format("tgTestSide({}u, (", file_.counted.size()), tokens_[i]);
                for (const int side : {0, 1})
                    (void)counted(question, side);
            }
            if (questions.contains(i)) emit("))", tokens_[i]);
            const auto kind = std::ranges::find(kAssertionKinds, tokens_[i].text, &AssertionKind::name);
            const bool member = i > 0 && is(i - 1, '.');
            if (kind != std::end(kAssertionKinds) && is(i + 1, '(')) {
                i = assertion(*kind, i);
            } else if (isWord(i) && !member && is(i + 1, '[') && closing_[i + 1] < last && elementsOf(i) != nullptr) {
                i = element(i);
            } else {
                copy(i++);
            }
        }
    }

    /// Null: no array, or an index that needs no check.
    [[nodiscard]] const std::string* elementsOf(std::size_t i) const {
        const auto found = locals_.find(std::string(tokens_[i].text));
        if (found == locals_.end() || found->second.empty()) return nullptr;
        const bool constant = closing_[i + 1] == i + 3 && tokens_[i + 2].kind == TokenKind::Number;
        const bool declares = i > 0 && isWord(i - 1) && !isNoType(tokens_[i - 1].text);
        return constant || declares ? nullptr : &found->second;
    }

    std::size_t element(std::size_t i) {
        const std::string count = *elementsOf(i);
        const std::size_t close = closing_[i + 1];
        copy(i, i + 2);
        emit("tgTestAt(int(", tokens_[i + 1]);
        expression(i + 2, close);
        emit(fmt::format("), uint({}), {}u)", count, site(SiteKind::Index, i, close + 1)), tokens_[close]);
        copy(close);
        return close + 1;
    }

    /// Of numbers alone, to which DXC gives no type that a function could be chosen by; else empty.
    [[nodiscard]] std::string literalType(const TokenRange& range) const {
        std::string type = "int";
        std::size_t first = range.first;
        for (std::size_t i = range.first; i < range.last; ++i)
            if (is(i, '?')) first = i + 1;
        for (std::size_t i = first; i < range.last; ++i) {
            const std::string_view text = tokens_[i].text;
            if (isWord(i) || is(i, '<') || is(i, '>') || is(i, '=') || is(i, '!')) return {};
            if (tokens_[i].kind != TokenKind::Number) continue;
            const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
            if (!hexadecimal && text.find_first_of(".eEfF") != std::string_view::npos) type = "float";
            if ((text.back() == 'u' || text.back() == 'U') && type == "int") type = "uint";
        }
        return type;
    }

    std::size_t assertion(const AssertionKind& kind, std::size_t i) {
        const std::size_t close = closing_[i + 1];
        const std::vector<TokenRange> given = argumentsOf(tokens_, closing_, i + 1);
        if (given.size() < kind.values + (kind.limited ? 1 : 0) || (given.size() > kind.values && !kind.limited))
            fail(8202, tokens_[i], fmt::format("{} takes {} arguments{}", kind.name, kind.values, kind.limited ? " and a tolerance" : ""),
                 kind.limited ? "tgNear(value, expected, 0.001), or tgAbsolute(0.001), tgRelative(0.001), tgUlp(4)" : "");
        const std::uint32_t number = site(kind.kind, i, close + 1);
        const bool isWatch = kind.kind == SiteKind::Watch;
        if (isWatch) file_.sites.back().text = textOf(tokens_, i + 2, close);
        if (file_.sites.back().isProperty()) {
            property(kind, number, given);
            return close + 1;
        }
        emit(fmt::format("{}({}u", isWatch ? "tgTestNote" : "tgTest" + std::string(kind.name.substr(2)), number), tokens_[i]);
        for (std::size_t a = 0; a < kind.values; ++a) {
            const std::string type = literalType(given[a]);
            emit(kind.kind == SiteKind::True ? ", ("
                 : type.empty()              ? ", tgTestOf("
                                             : fmt::format(", tgTestOf({}(", type),
                 tokens_[given[a].first]);
            expression(given[a].first, given[a].last);
            emit(kind.kind == SiteKind::True || type.empty() ? ")" : "))", tokens_[given[a].last]);
        }
        for (std::size_t a = kind.values; a < given.size(); ++a) {
            emit(a + 1 < given.size() ? ", tgTestEither(" : ", ", tokens_[given[a].first]);
            expression(given[a].first, given[a].last);
        }
        emit(std::string(given.size() - std::min(given.size(), kind.values + 1) + 1, ')'), tokens_[close]);
        return close + 1;
    }

    void property(const AssertionKind& kind, std::uint32_t number, const std::vector<TokenRange>& given) {
        if (test_ == nullptr) fail(8202, tokens_[given[0].first], fmt::format("{} stands in a test", kind.name));
        file_.sites[number].property = test_->properties;
        test_->neighbours = true;
        const std::string type = literalType(given[0]);
        emit(fmt::format("tgTestProperty({}u, {}u, tgTestOf({}(", number, test_->properties++, type), tokens_[given[0].first]);
        expression(given[0].first, given[0].last);
        emit(")), ", tokens_[given[0].last]);
        if (given.size() > 1)
            expression(given[1].first, given[1].last);
        else
            emit("0.0", tokens_[given[0].last]);
        emit(")", tokens_[given[0].last]);
    }

    /// What a mutant may change between these tokens.
    void mutable_(std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            if (is(i, '[')) { // sizes, indices and attributes
                i = closing_[i];
                continue;
            }
            const Token& token = tokens_[i];
            std::string to;
            if (token.kind == TokenKind::Number) {
                to = token.text.find_first_of(".eE") == std::string_view::npos || token.text.starts_with("0x")
                         ? fmt::format("({} + 1)", token.text)
                         : fmt::format("({} * 1.01 + 0.001)", token.text);
            } else if (const auto found = std::ranges::find(kOpposites, token.text, [](const auto& each) { return each[0]; });
                       found != std::end(kOpposites) && i > first && i + 1 < last) {
                const Token& before = tokens_[i - 1];
                const bool operand = before.kind != TokenKind::Sign || before.is(')') || before.is(']');
                const bool twice = is(i + 1, token.text[0]) || before.text == token.text;
                if (isWord(i) ? !is(i + 1, '(') : !operand || twice || tokens_[i - 1].is("return")) continue;
                to = (*found)[1];
            } else {
                continue;
            }
            file_.mutants.push_back({.token = i, .at = sources_.position(token), .from = std::string(token.text), .to = std::move(to)});
        }
    }

    const Preprocessed& view_;
    const std::vector<Token>& tokens_;
    Sources& sources_;
    const ReadOptions& options_;
    TestFile& file_;
    DeclarationReader reader_;
    Preprocessed out_;
    std::vector<std::size_t> closing_;
    std::vector<bool> blanked_;
    std::optional<Effect> effect_;
    std::size_t pragma_ = 0;
    std::map<std::string, std::string> arrays_; // of the file
    std::map<std::string, std::string> locals_; // and of the function
    std::set<std::string> floats_;
    std::string returns_;
    std::vector<std::vector<std::size_t>> loops_; // of the function and of each loop around: those directly in it
    std::size_t loopCount_ = 0;
    std::vector<Fixture> shared_;
    Test* test_ = nullptr;
};

} // namespace

Result<Rewritten> rewrite(const Preprocessed& view, Sources& sources, const Roots& roots, const ReadOptions& options, TestFile& file) {
    try {
        return Rewriter(view, sources, roots, options, file).run();
    } catch (const Error& error) {
        return error;
    }
}

} // namespace tegument::testing
