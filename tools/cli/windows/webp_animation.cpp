#include "host/support/windows/left_out.h"
#include "tools/cli/animation.h"

namespace tegument::app {

Result<std::unique_ptr<Animation>> makeWebp(const AnimationFormat&) {
    return leftOut("animations as WebP (-o NAME.png makes numbered pictures)");
}

} // namespace tegument::app
