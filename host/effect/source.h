#pragma once
// Texts and their tokens. Every token knows where it was written, so that every later message does too.

#include "host/support/result.h"

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

enum class TokenKind { Word, Number, String, BadString, Sign, Newline };

/// A token of the source. Signs are single characters: `<=` is `<` followed by a `=` without space.
struct Token {
    TokenKind kind = TokenKind::Sign;
    bool space = false;    // white space, a comment or a line break before it
    bool noExpand = false; // a macro's name inside its own expansion
    int file = 0;          // index into Sources
    int line = 0;
    int column = 0; // in bytes, from 1
    std::string_view text;

    [[nodiscard]] bool is(char sign) const { return kind == TokenKind::Sign && text[0] == sign; }
    [[nodiscard]] bool is(std::string_view word) const { return kind == TokenKind::Word && text == word; }
};

/// One inclusion of a file (the same file included twice is two of these).
struct Source {
    std::string name;
    std::shared_ptr<const std::string> text;
};

/// Owns every text that tokens point into.
class Sources {
public:
    int add(std::string name, std::shared_ptr<const std::string> text);
    /// Keeps a text that the preprocessor made (pasted tokens).
    std::string_view keep(std::string text);

    [[nodiscard]] const Source& operator[](int file) const { return files_[static_cast<std::size_t>(file)]; }
    [[nodiscard]] int size() const { return static_cast<int>(files_.size()); }
    [[nodiscard]] SourcePosition position(const Token& token) const;
    /// The text of a line without its line ending; at most 200 bytes of it.
    [[nodiscard]] std::string line(std::string_view name, int number) const;

private:
    std::deque<Source> files_;
    std::deque<std::string> made_;
};

/// Fills in the source line under a diagnostic, if it has a position in one of the sources.
void quote(Diagnostic& diagnostic, const Sources& sources);

struct LexResult {
    std::vector<Token> tokens; // with Newline tokens
    std::vector<Diagnostic> errors;
};

/// Splits a text into tokens; comments and spliced lines count as white space. TG1003 unterminated comment.
/// An unterminated string becomes BadString: it is no error where `#if 0` removes it.
[[nodiscard]] LexResult lex(const Sources& sources, int file);
/// The tokens of a text that Sources keeps, all at the place of `at`.
[[nodiscard]] std::vector<Token> tokensOf(const Sources& sources, std::string_view text, const Token& at);

} // namespace tegument
