#include "tools/cli/animation.h"
#include "host/support/windows/left_out.h"

namespace tegument::app {

Result<std::unique_ptr<Animation>> makeAnimation(const AnimationFormat&) {
    return leftOut("animations as WebP (-o NAME.png makes numbered pictures)");
}

} // namespace tegument::app
