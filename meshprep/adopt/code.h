#pragma once
// The plain HLSL of an effect, read at the level of declarations: what the rewriting to a later Direct3D's spelling works on. Bodies of
// functions stay lists of words.

#include "host/effect/source.h"
#include "host/support/result.h"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tegument::adopt {

/// A word of the code with the place that its author knows.
struct Word {
    std::string text;
    TokenKind kind = TokenKind::Sign;
    bool space = false;
    int file = 0; // index into Code::files
    int line = 0;

    [[nodiscard]] bool is(std::string_view other) const { return text == other; }
    [[nodiscard]] bool isName() const { return kind == TokenKind::Word; }
};

using Words = std::vector<Word>;

/// A variable, a member or a parameter of a function.
struct Variable {
    Words modifiers;
    Words type; // `float4`, `vector < float , 4 >`
    Word name;
    Words array;          // `[ 4 ]`, with its brackets
    std::string semantic; // as written; empty: none
    Words initial;        // behind '='

    [[nodiscard]] bool has(std::string_view modifier) const;
    [[nodiscard]] const std::string& typeName() const { return type.front().text; }
};

struct Structure {
    std::string name;
    std::vector<Variable> members;
    Words whole; // of one with methods or bases: it is copied as it is
};

struct Function {
    Words attributes; // `[maxvertexcount(3)]`
    Words modifiers;
    Words type;
    Word name;
    std::vector<Variable> parameters;
    std::string semantic;
    Words body; // with its braces; empty: declared only

    [[nodiscard]] const std::string& typeName() const { return type.front().text; }
};

/// typedef, using, what is not understood: copied.
struct Other {
    std::string name; // what it declares; may be empty
    Words words;
};

using Item = std::variant<Structure, Function, Variable, Other>;

struct Code {
    std::vector<std::string> files;
    std::vector<Item> items;          // in their order
    std::vector<std::string> pragmas; // that change what follows: pack_matrix

    std::map<std::string, std::vector<std::size_t>, std::less<>> byName; // indices into `items`

    [[nodiscard]] const Structure* structure(std::string_view name) const;
    /// The type behind a typedef, or the type itself.
    [[nodiscard]] Words resolved(const Words& type) const;
    /// Functions of that name with a body.
    [[nodiscard]] std::vector<const Function*> functions(std::string_view name) const;
    [[nodiscard]] const Variable* variable(std::string_view name) const;
};

/// Reads what codeView() wrote. What it does not understand becomes Other: the compiler shall say what is wrong with it.
[[nodiscard]] Code readCode(std::string_view text);

/// `{ ... }`, `( ... )`, `[ ... ]` from `at`: one behind its end.
[[nodiscard]] std::size_t behindBracket(const Words& words, std::size_t at);

/// Splits at the commas that no bracket holds.
[[nodiscard]] std::vector<Words> splitAtCommas(const Words& words, std::size_t first, std::size_t last);

/// Prints words where their author wrote them, by `#line`.
class Printer {
public:
    explicit Printer(const std::vector<std::string>& files) : files_(files) {}
    void print(const Words& words);
    void print(const Word& word);
    /// Text of our own, on lines of its own: messages in it have no place in the author's file.
    void own(const std::string& text);
    [[nodiscard]] std::string take() { return std::move(text_) + '\n'; }

private:
    const std::vector<std::string>& files_;
    std::string text_;
    int file_ = -1;
    int line_ = 0;
};

} // namespace tegument::adopt
