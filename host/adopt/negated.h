#pragma once
// Which parameters the code turns round before it uses them: a light's direction that is negated goes the way that light goes.

#include "host/adopt/code.h"

#include <set>
#include <string>

namespace tegument::adopt {

/// Names with a '-' before them, themselves or after the code has handed them on: by an assignment without arithmetic, or to a function.
[[nodiscard]] std::set<std::string> negatedNames(const Code& code);

} // namespace tegument::adopt
