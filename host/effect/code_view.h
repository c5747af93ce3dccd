#pragma once
// The plain HLSL that DXC and glslang get.

#include "host/effect/parser.h"
#include "host/effect/preprocess.h"

#include <string>

namespace tegument {

/// Prints the tokens where they were written, with `#line` where that jumps, and without those in `blanks`.
[[nodiscard]] std::string codeView(const Preprocessed& view, const Sources& sources, const std::vector<TokenRange>& blanks);

} // namespace tegument
