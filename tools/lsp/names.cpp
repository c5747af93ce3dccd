#include "tools/lsp/names.h"

#include "host/support/text.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

namespace tegument::lsp {

namespace {

constexpr std::array<std::string_view, 26> kNoTypes = {
    "return",    "else",        "if",   "for",  "while",   "do",     "in",       "out",     "inout",  "uniform", "const", "static",
    "extern",    "compile",     "case", "goto", "typedef", "shared", "volatile", "precise", "define", "include", "undef", "nointerpolation",
    "row_major", "column_major"};
constexpr std::array<std::string_view, 8> kNamed = {"struct",      "cbuffer",     "tbuffer", "technique",
                                                    "technique10", "technique11", "pass",    "interface"};

template <class List>
bool isOneOf(const List& list, std::string_view word) {
    return std::ranges::find(list, word) != list.end();
}

std::string_view kindOf(std::string_view keyword) {
    if (keyword.starts_with("technique")) return "technique";
    if (keyword == "pass" || keyword == "struct") return keyword;
    return "block";
}

std::vector<Token> tokensOf(Sources& sources, const std::string& file, const std::string& text) {
    const int index = sources.add(file, std::make_shared<const std::string>(text));
    return lex(sources, index).tokens;
}

/// Walks over the tokens once, and keeps what looks like a declaration.
class Reader {
public:
    Reader(const std::string& file, const std::string& text) : text_(text), tokens_(tokensOf(sources_, file, text)) { found_.file = file; }

    FileNames run() {
        while (at_ < tokens_.size())
            step();
        closeBlock();
        return std::move(found_);
    }

private:
    [[nodiscard]] const Token* peek(std::size_t ahead) const { return at_ + ahead < tokens_.size() ? &tokens_[at_ + ahead] : nullptr; }
    [[nodiscard]] bool isAt(std::size_t ahead, char sign) const { return peek(ahead) != nullptr && peek(ahead)->is(sign); }
    [[nodiscard]] bool wordAt(std::size_t ahead) const { return peek(ahead) != nullptr && peek(ahead)->kind == TokenKind::Word; }

    void step() {
        const Token& token = tokens_[at_];
        if (token.kind == TokenKind::Newline) {
            lineBegins_ = true;
            ++at_;
            return;
        }
        const bool begins = lineBegins_;
        lineBegins_ = false;
        if (begins && token.is('#')) return directive();
        if (token.kind == TokenKind::Sign) bracket(token.text[0]);
        if (token.kind == TokenKind::Word) word(token);
        ++at_;
    }

    void directive() {
        if (wordAt(1) && peek(1)->is("define") && wordAt(2)) add(*peek(2), "macro", {});
        if (wordAt(1) && peek(1)->is("include") && peek(2) != nullptr && peek(2)->kind == TokenKind::String && peek(2)->text.size() > 2)
            found_.includes.emplace_back(peek(2)->line, peek(2)->text.substr(1, peek(2)->text.size() - 2));
        while (at_ < tokens_.size() && tokens_[at_].kind != TokenKind::Newline)
            ++at_;
    }

    void bracket(char sign) {
        if (sign == '{') ++braces_;
        if (sign == '(') ++parentheses_;
        if (sign == '}') braces_ = std::max(0, braces_ - 1);
        if (sign == ')') parentheses_ = std::max(0, parentheses_ - 1);
        if ((sign == '}' || sign == ';') && braces_ == 0) closeBlock();
    }

    void word(const Token& token) {
        if (isOneOf(kNamed, token.text) && wordAt(1)) return add(*peek(1), std::string(kindOf(token.text)), {});
        if (isOneOf(kNoTypes, token.text)) return;
        const std::size_t name = behindTypeArguments();
        if (name == 0 || !wordAt(name) || isOneOf(kNoTypes, peek(name)->text)) return;
        const Token* next = peek(name + 1);
        if (next == nullptr || next->kind != TokenKind::Sign || std::string_view("(;=[:,){<").find(next->text[0]) == std::string_view::npos)
            return;
        const bool outside = braces_ == 0 && parentheses_ == 0;
        if (next->is('(') && !outside) return; // a call
        add(*peek(name), next->is('(') ? "function" : outside ? "global" : "local", std::string(token.text));
    }

    /// Tokens to the name that follows a type: 1, or behind `<float4>`; 0 where none does.
    [[nodiscard]] std::size_t behindTypeArguments() const {
        if (!isAt(1, '<')) return 1;
        for (std::size_t ahead = 2; ahead < 8 && peek(ahead) != nullptr; ++ahead)
            if (peek(ahead)->is('>')) return ahead + 1;
        return 0;
    }

    void add(const Token& token, std::string kind, std::string type) {
        const bool local = kind == "local";
        found_.declarations.push_back({.name = std::string(token.text),
                                       .kind = std::move(kind),
                                       .type = std::move(type),
                                       .line = std::string(trim(lineOf(text_, token.line))),
                                       .at = sources_.position(token),
                                       .from = local ? token.line : 0});
        if (local) open_.push_back(found_.declarations.size() - 1);
    }

    /// What was declared inside is seen no further.
    void closeBlock() {
        const int line = at_ < tokens_.size() ? tokens_[at_].line : 1 << 30;
        for (const std::size_t index : open_)
            found_.declarations[index].to = line;
        open_.clear();
    }

    const std::string& text_;
    Sources sources_;
    std::vector<Token> tokens_;
    FileNames found_;
    std::vector<std::size_t> open_;
    std::size_t at_ = 0;
    int braces_ = 0;
    int parentheses_ = 0;
    bool lineBegins_ = true;
};

constexpr std::array<std::string_view, 6> kOpeners = {"pass",          "struct",       "cbuffer",
                                                      "sampler_state", "SamplerState", "SamplerComparisonState"};

} // namespace

FileNames namesOf(const std::string& file, const std::string& text) {
    return Reader(file, text).run();
}

Place placeAt(const std::string& text, int line, int column) {
    Sources sources;
    std::vector<Token> before;          // of the statement
    std::vector<std::string_view> open; // by which word each brace that is still open was
    std::string_view opener;
    int parentheses = 0;
    for (const Token& token : tokensOf(sources, "", text)) {
        const int end = token.column + static_cast<int>(token.text.size()); // a word that touches the cursor is being typed
        if (token.line > line || (token.line == line && (token.kind == TokenKind::Sign ? end > column : end >= column))) break;
        if (token.kind == TokenKind::Newline) continue;
        if (token.is('(')) ++parentheses;
        if (token.is(')')) parentheses = std::max(0, parentheses - 1);
        if (isOneOf(kOpeners, token.text)) opener = token.text;
        if (token.is('{')) open.push_back(std::exchange(opener, {}));
        if (token.is('}') && !open.empty()) open.pop_back();
        if (token.is(';') && opener != "pass") opener = {}; // a pass may have annotations, each with its semicolon
        before.push_back(token);
        if (token.is('{') || token.is('}') || token.is(';')) before.clear();
    }
    const std::string_view in = open.empty() ? std::string_view() : open.back();
    const bool sampler = in == "sampler_state" || in.starts_with("Sampler");
    const auto equals = std::ranges::find_if(before, [](const Token& token) { return token.is('='); });
    if ((sampler || in == "pass") && equals != before.end())
        return {.context = Context::Value,
                .sampler = sampler,
                .state = equals == before.begin() ? std::string() : std::string(before.front().text)};
    if (sampler) return {.context = Context::SamplerState, .sampler = true};
    if (in == "pass") return {.context = Context::PassState};
    const bool asked = std::ranges::any_of(before, [](const Token& token) { return token.is('?'); });
    if (!before.empty() && before.back().is(':') && !asked)
        return {.context = Context::Semantic,
                .global =
                    open.empty() && parentheses == 0 && std::ranges::none_of(before, [](const Token& token) { return token.is(')'); })};
    return {};
}

std::string_view lineOf(std::string_view text, int line) {
    std::size_t start = 0;
    for (int i = 1; i < line; ++i) {
        start = text.find('\n', start);
        if (start == std::string_view::npos) return {};
        ++start;
    }
    const std::string_view rest = text.substr(start);
    return rest.substr(0, rest.find_first_of("\r\n"));
}

std::string wordAt(std::string_view line, int column) {
    const auto isLetter = [&](std::size_t i) {
        const char c = line[i];
        return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    };
    if (column < 1) return {};
    std::size_t first = std::min(static_cast<std::size_t>(column - 1), line.size());
    std::size_t last = first;
    while (first > 0 && isLetter(first - 1))
        --first;
    while (last < line.size() && isLetter(last))
        ++last;
    return std::string(line.substr(first, last - first));
}

} // namespace tegument::lsp
