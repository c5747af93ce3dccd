#pragma once
// Macro definitions and their expansion.

#include "host/effect/source.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

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

/// Whether `tokens[i]` and `tokens[i + 1]` are the operator `##`.
[[nodiscard]] bool isPaste(std::span<const Token> tokens, std::size_t i);

} // namespace tegument
