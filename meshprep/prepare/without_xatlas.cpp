// A build without xatlas (TEGUMENT_XATLAS_DIR): unwrap.cpp is left out.

#include "meshprep/prepare/unwrap.h"

namespace tegument::prep {

Result<Unwrapping> unwrap(Surface& /*surface*/) {
    return machineError(7027, "this build has no xatlas, which makes texture coordinates", "./bootstrap build fetches it and builds again");
}

} // namespace tegument::prep
