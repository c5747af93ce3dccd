#include "host/app/animation.h"
#include "host/support/windows/left_out.h"

namespace tegument::app {

Result<std::unique_ptr<Animation>> makeGif(const AnimationFormat&) {
    return leftOut("animations as GIF: name a folder of pictures");
}

} // namespace tegument::app
