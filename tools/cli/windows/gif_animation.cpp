#include "host/support/windows/left_out.h"
#include "tools/cli/animation.h"

namespace tegument::app {

Result<std::unique_ptr<Animation>> makeGif(const AnimationFormat&) {
    return leftOut("animations as GIF (-o NAME.png makes numbered pictures)");
}

} // namespace tegument::app
