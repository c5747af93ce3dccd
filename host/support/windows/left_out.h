#pragma once
// What the build for Windows does not have; docs/design/windows.md has the list and the reasons.

#include "host/support/left_out.h"

namespace tegument {

inline Error leftOut(const std::string& what) {
    return leftOut(what, "docs/design/windows.md says what else and why; the build for Linux has it");
}

} // namespace tegument
