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

[[nodiscard]] inline FunctionCase passCase(const char* effect, Globals globals, Call call, Arguments arguments, Tolerance tolerance,
                                           Reference expected) {
    return check(std::move(call), std::move(arguments), std::move(tolerance),
                 {.samples = 1024, .globals = std::move(globals), .effect = effect}, std::move(expected));
}

/// The same number, or vector, for each of these parameters.
inline void setAll(FunctionCase& made, std::initializer_list<const char*> names, const std::vector<double>& value) {
    for (const char* name : names)
        made.globals[name] = value;
}

[[nodiscard]] inline std::vector<double> numbersOf(const dvec3& v) {
    return {v.x, v.y, v.z};
}

} // namespace tegument::test
