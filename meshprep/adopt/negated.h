#pragma once
// Which parameters the code turns round before it uses them: a light's direction that is negated goes the way that light goes.

#include "meshprep/adopt/code.h"

#include <set>
#include <string>

namespace tegument::adopt {

/// Names with a '-' before them, themselves or after the code has handed them on: by an assignment without arithmetic, or to a function.
/// Members of structures, whatever the structure's name, stand there with a dot: ".Direction".
[[nodiscard]] std::set<std::string> negatedNames(const Code& code);

/// `parameter`: as the members of structures are called when they are parameters of their own, "lights_0_Direction".
[[nodiscard]] bool isNegated(const std::set<std::string>& names, std::string_view parameter);

} // namespace tegument::adopt
