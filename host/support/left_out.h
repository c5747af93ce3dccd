#pragma once

#include "host/support/result.h"

#include <string>

namespace tegument {

/// What a build was made without. Exit code 3.
inline Error leftOut(const std::string& what, const std::string& hint) {
    return machineError(8051, "this build leaves out " + what, hint);
}

} // namespace tegument
