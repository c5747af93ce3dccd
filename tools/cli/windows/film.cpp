#include "host/support/windows/left_out.h"
#include "tools/cli/animation.h"

namespace tegument::app {

Result<std::unique_ptr<Animation>> makeFilm(const AnimationFormat&) {
    return leftOut("films (-o NAME.png makes numbered pictures)");
}

} // namespace tegument::app
