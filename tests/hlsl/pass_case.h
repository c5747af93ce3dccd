#pragma once
// What cases of passes of effects have in common, whatever the effect.

#include "tests/hlsl/function_case.h"

#include <initializer_list>

namespace tegument::test {

using Globals = std::map<std::string, std::vector<double>>;

/// `first`, with these in place of its own.
[[nodiscard]] inline Globals with(const Globals& first, Globals others) {
    others.insert(first.begin(), first.end());
    return others;
}

[[nodiscard]] inline FunctionCase passCase(const char* effect, Globals globals, const char* function, std::string body,
                                           std::vector<Argument> arguments, std::function<Values(const Inputs&)> expected,
                                           Tolerance tolerance) {
    return {.function = function,
            .body = std::move(body),
            .arguments = std::move(arguments),
            .expected = std::move(expected),
            .tolerance = std::move(tolerance),
            .samples = 1024,
            .globals = std::move(globals),
            .effect = effect};
}

/// The same number, or vector, for each of these parameters.
inline void setAll(FunctionCase& made, std::initializer_list<const char*> names, const std::vector<double>& value) {
    for (const char* name : names)
        made.globals[name] = value;
}

[[nodiscard]] inline std::vector<double> numbersOf(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

} // namespace tegument::test
