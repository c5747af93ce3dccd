#pragma once
// Inside this room: what a test declares for itself, its inputs and fixtures.

#include "host/effect/parser.h"
#include "host/support/roots.h"
#include "tools/test/test_file.h"

#include <span>

namespace tegument::testing {

using Tokens = std::vector<Token>;
using Partners = std::vector<std::size_t>; // of each opening bracket the closing one

/// As written, with single spaces.
[[nodiscard]] std::string textOf(const Tokens& tokens, std::size_t first, std::size_t last);
/// Between the bracket at `open` and its partner, separated by commas.
[[nodiscard]] std::vector<TokenRange> argumentsOf(const Tokens& tokens, const Partners& closing, std::size_t open);
[[nodiscard]] bool isFixture(std::string_view word);
/// Without the quotation marks of a string.
[[nodiscard]] std::string unquoted(std::string text);

/// Throws what is wrong as an Error.
class DeclarationReader {
public:
    DeclarationReader(const Sources& sources, const Roots& roots, const TestFile& file) : sources_(sources), roots_(roots), file_(file) {}

    /// `tgTexture(name, ...);`, the word at `at`.
    [[nodiscard]] Fixture fixture(const Tokens& tokens, const Partners& closing, std::size_t at) const;
    /// Of `float gAmount = 0.5;`, a uniform of the file.
    [[nodiscard]] std::optional<Fixture> defaultOf(const Tokens& tokens, const Partners& closing, std::size_t first,
                                                   std::size_t last) const;
    /// The threads of TG_GROUP_TEST.
    [[nodiscard]] std::array<std::uint32_t, 3> groupOf(const Tokens& tokens, std::size_t at, std::size_t close) const;

    void start(Test& test);
    struct Input {
        std::size_t name = 0; // its token
        std::string code;     // that declares it
    };
    /// Of `float x = tgRange(...);`
    [[nodiscard]] std::optional<Input> input(const Tokens& tokens, const Partners& closing, std::size_t first, std::size_t last,
                                             bool inTest);
    /// Counts the test's cases.
    [[nodiscard]] std::optional<Error> finish(Test& test) const;

private:
    struct Dimension {
        std::string table; // whose rows these are
        std::uint32_t count = 0;
        std::uint32_t stride = 0;
        std::size_t start = 0; // in the test's numbers
        Table content;
    };

    [[noreturn]] void fail(const Token& at, std::string text, std::string hint = {}) const;
    [[nodiscard]] std::uint32_t countIn(const Tokens& tokens, const TokenRange& argument) const;
    [[nodiscard]] std::vector<double> numbersIn(const Tokens& tokens, TokenRange range) const;
    [[nodiscard]] std::filesystem::path fileIn(const Token& string) const;
    void sizes(const Tokens& tokens, std::span<const TokenRange> given, Fixture& made) const;
    Dimension& dimension(const Token& at, std::uint32_t count, std::string table = {});
    [[nodiscard]] std::string fromTable(const Tokens& tokens, const std::vector<TokenRange>& given, const std::string& type);

    const Sources& sources_;
    const Roots& roots_;
    const TestFile& file_;
    Test* test_ = nullptr;
    std::vector<Dimension> dimensions_;
    std::uint32_t inputs_ = 0;
    std::uint32_t draws_ = 0; // random cases at least
};

} // namespace tegument::testing
