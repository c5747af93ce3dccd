#include "host/effect/source.h"

#include <cctype>

namespace tegument {

namespace {

constexpr std::size_t kLongestQuote = 200;

bool startsWord(char c) {
    return c == '_' || std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool continuesWord(char c) {
    return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0;
}

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

class Lexer {
public:
    Lexer(const Sources& sources, int file, std::string_view text) : sources_(sources), file_(file), text_(text) {
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = lineStart_ = 3;
    }

    LexResult run() {
        while (at_ < text_.size())
            step();
        return std::move(result_);
    }

private:
    [[nodiscard]] char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

    /// Length of a line ending at the cursor: 0, 1 or 2.
    [[nodiscard]] std::size_t lineEnding(std::size_t ahead = 0) const {
        if (peek(ahead) == '\n') return 1;
        return peek(ahead) == '\r' && peek(ahead + 1) == '\n' ? 2 : 0;
    }

    void newLine(std::size_t length) {
        at_ += length;
        ++line_;
        lineStart_ = at_;
    }

    void emit(TokenKind kind, std::size_t length) {
        result_.tokens.push_back({.kind = kind,
                                  .space = space_,
                                  .file = file_,
                                  .line = line_,
                                  .column = static_cast<int>(at_ - lineStart_) + 1,
                                  .text = text_.substr(at_, length)});
        space_ = false;
        at_ += length;
    }

    void step() {
        const char c = peek();
        if (const std::size_t ending = lineEnding()) {
            emit(TokenKind::Newline, 0);
            newLine(ending);
            space_ = true;
        } else if (c == '\\' && lineEnding(1) > 0) {
            newLine(1 + lineEnding(1));
            space_ = true;
        } else if (std::isspace(static_cast<unsigned char>(c)) != 0) {
            ++at_;
            space_ = true;
        } else if (c == '/' && peek(1) == '/') {
            lineComment();
        } else if (c == '/' && peek(1) == '*') {
            blockComment();
        } else if (c == '"') {
            string();
        } else if (startsWord(c)) {
            word();
        } else if (isDigit(c) || (c == '.' && isDigit(peek(1)))) {
            number();
        } else {
            emit(TokenKind::Sign, 1);
        }
    }

    void lineComment() {
        space_ = true;
        while (at_ < text_.size() && lineEnding() == 0) {
            if (peek() == '\\' && lineEnding(1) > 0) {
                newLine(1 + lineEnding(1));
            } else {
                ++at_;
            }
        }
    }

    void blockComment() {
        const SourcePosition opened{sources_[file_].name, line_, static_cast<int>(at_ - lineStart_) + 1, std::nullopt};
        space_ = true;
        at_ += 2;
        while (at_ < text_.size()) {
            if (peek() == '*' && peek(1) == '/') {
                at_ += 2;
                return;
            }
            if (peek() == '\n') {
                newLine(1);
            } else {
                ++at_;
            }
        }
        result_.errors.push_back({.code = 1003, .at = opened, .text = "this comment is never closed", .hint = "close it with '*/'"});
    }

    void string() {
        std::size_t length = 1;
        while (at_ + length < text_.size() && peek(length) != '"' && lineEnding(length) == 0)
            length += peek(length) == '\\' && lineEnding(length + 1) == 0 && at_ + length + 1 < text_.size() ? 2 : 1;
        if (peek(length) == '"') {
            emit(TokenKind::String, length + 1);
        } else {
            emit(TokenKind::BadString, length);
        }
    }

    void word() {
        std::size_t length = 1;
        while (continuesWord(peek(length)))
            ++length;
        emit(TokenKind::Word, length);
    }

    void number() {
        std::size_t length = 1;
        const bool hexadecimal = peek() == '0' && (peek(1) == 'x' || peek(1) == 'X');
        while (continuesWord(peek(length)) || peek(length) == '.' ||
               (!hexadecimal && (peek(length) == '+' || peek(length) == '-') && (peek(length - 1) == 'e' || peek(length - 1) == 'E')))
            ++length;
        if (peek(length) == '#' && peek(length - 1) == '.') // 1.#INF, -1.#IND
            for (++length; std::isalpha(static_cast<unsigned char>(peek(length))) != 0;)
                ++length;
        emit(TokenKind::Number, length);
    }

    const Sources& sources_;
    int file_;
    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t lineStart_ = 0;
    int line_ = 1;
    bool space_ = true;
    LexResult result_;
};

} // namespace

int Sources::add(std::string name, std::shared_ptr<const std::string> text) {
    files_.push_back({std::move(name), std::move(text)});
    return size() - 1;
}

std::string_view Sources::keep(std::string text) {
    return made_.emplace_back(std::move(text));
}

SourcePosition Sources::position(const Token& token) const {
    return {(*this)[token.file].name, token.line, token.column, std::nullopt};
}

std::string Sources::line(std::string_view name, int number) const {
    for (const Source& source : files_) {
        if (source.name != name) continue;
        const std::string_view text = *source.text;
        std::size_t start = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
        for (int i = 1; i < number && start != std::string_view::npos; ++i) {
            const std::size_t end = text.find('\n', start);
            start = end == std::string_view::npos ? end : end + 1;
        }
        if (start == std::string_view::npos) return {};
        const std::string_view rest = text.substr(start, kLongestQuote);
        return std::string(rest.substr(0, rest.find_first_of("\r\n")));
    }
    return {};
}

void quote(Diagnostic& diagnostic, const Sources& sources) {
    if (diagnostic.at.line == 0) return;
    diagnostic.sourceLine = sources.line(diagnostic.at.file, diagnostic.at.line);
    if (diagnostic.at.column > static_cast<int>(diagnostic.sourceLine.size()) + 1) diagnostic.sourceLine.clear();
}

LexResult lex(const Sources& sources, int file) {
    return Lexer(sources, file, *sources[file].text).run();
}

std::vector<Token> tokensOf(const Sources& sources, std::string_view text, const Token& at) {
    std::vector<Token> tokens = Lexer(sources, at.file, text).run().tokens;
    for (Token& token : tokens) {
        token.line = at.line;
        token.column = at.column;
    }
    return tokens;
}

} // namespace tegument
