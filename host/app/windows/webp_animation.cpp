#include "host/app/animation.h"
#include "host/support/windows/left_out.h"

namespace tegument::app {

Result<std::unique_ptr<Animation>> makeWebp(const AnimationFormat&) {
    return leftOut("animations as WebP: name a folder of pictures");
}

} // namespace tegument::app
