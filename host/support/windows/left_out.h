#pragma once
// What the build for Windows does not have; docs/design/windows.md has the list and the reasons.

#include "host/support/result.h"

#include <string>

namespace tegument {

/// Exit code 3.
inline Error leftOut(const std::string& what) {
    return machineError(8051, "this build for Windows leaves out " + what,
                        "docs/design/windows.md says what else and why; the build for Linux has it");
}

} // namespace tegument
