#pragma once
// One file instead of a tree of includes.

#include "host/effect/preprocess.h"

#include <string>

namespace tegument {

/// The text of `file` with every include in its place: comments, macros and conditionals stay as they were written, so defines select the
/// same as before. A file with an include guard is merged where it is first read for certain, others wherever they are included. `#pragma
/// once` becomes a guard. Without #line: comments say where each file begins and ends. The result is preprocessed and compared with the
/// original, token by token, for every target; TG3305 when it differs or when an include is named by a macro; TG1001 and the other codes of
/// preprocess() when the original is at fault.
[[nodiscard]] Result<std::string> flattenEffect(const std::filesystem::path& file, const PreprocessOptions& options);

/// The text of `file`, the head of a library of functions, with every include in its place and TEGUMENT_LIBRARY known to be defined: what
/// it and the include guards decide is decided, so that only what a client may define remains, behind one guard, TEGUMENT_HLSL. The first
/// lines of comment stay first. Compared with the original as flattenEffect compares; the same errors.
[[nodiscard]] Result<std::string> flattenLibrary(const std::filesystem::path& file, const PreprocessOptions& options);

} // namespace tegument
