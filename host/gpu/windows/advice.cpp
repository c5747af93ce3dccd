#include "host/gpu/advice.h"

namespace tegument::gpu::detail {

Advice advice() {
    return {.loader = "vulkan-1.dll",
            .toGetLoader = "it comes with the graphics card's driver",
            .toGetDriver = "install the graphics card's driver; in Wine, set DISPLAY, or run it by xvfb-run"};
}

} // namespace tegument::gpu::detail
