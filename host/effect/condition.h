#pragma once
// The expression of #if and #elif.

#include "host/effect/source.h"

#include <cstdint>
#include <span>
#include <string>
#include <variant>

namespace tegument {

struct ConditionError {
    std::size_t token = 0; // index into the tokens, or their count for "at the end"
    std::string text;
};

/// Integer arithmetic of 64 bits that wraps; names left over after macro expansion are 0; `defined` is already replaced.
[[nodiscard]] std::variant<std::int64_t, ConditionError> evaluateCondition(std::span<const Token> tokens);

} // namespace tegument
