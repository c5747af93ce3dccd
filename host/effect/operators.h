#pragma once
// The operators between two values that HLSL shares with its preprocessor.

#include <array>
#include <optional>
#include <string_view>

namespace tegument {

constexpr int kDeepestExpression = 128; ///< nested brackets; bounds the recursion of who reads an expression

struct Operator {
    std::string_view text;
    int precedence; ///< the larger, the tighter it binds
};

/// Longer spellings first: signs are single characters, so `<=` is recognised before `<`.
constexpr std::array<Operator, 18> kOperators{{{"||", 1},
                                               {"&&", 2},
                                               {"==", 6},
                                               {"!=", 6},
                                               {"<=", 7},
                                               {">=", 7},
                                               {"<<", 8},
                                               {">>", 8},
                                               {"|", 3},
                                               {"^", 4},
                                               {"&", 5},
                                               {"<", 7},
                                               {">", 7},
                                               {"+", 9},
                                               {"-", 9},
                                               {"*", 10},
                                               {"/", 10},
                                               {"%", 10}}};

/// What a logical operator or a comparison says of two numbers; nullopt: `op` is neither.
template <class Number>
constexpr std::optional<bool> truth(std::string_view op, Number a, Number b) {
    if (op == "||") return a != 0 || b != 0;
    if (op == "&&") return a != 0 && b != 0;
    if (op == "==") return a == b;
    if (op == "!=") return a != b;
    if (op == "<=") return a <= b;
    if (op == ">=") return a >= b;
    if (op == "<") return a < b;
    if (op == ">") return a > b;
    return std::nullopt;
}

} // namespace tegument
