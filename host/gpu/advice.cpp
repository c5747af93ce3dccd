#include "host/gpu/advice.h"

namespace tegument::gpu::detail {

Advice advice() {
    return {.loader = "libvulkan.so.1",
            .toGetLoader = "install the Debian package libvulkan1",
            .toGetDriver = "install a Vulkan driver; the Debian package mesa-vulkan-drivers has one that runs on the CPU; NVIDIA's needs "
                           "libegl1, libgl1 and libxext6 as well"};
}

} // namespace tegument::gpu::detail
