// A Vulkan driver that brings the process down in which it is loaded.

#include <cstdlib>

// The name that the loader asks for. NOLINTNEXTLINE(readability-identifier-naming)
extern "C" __attribute__((visibility("default"))) void* vk_icdGetInstanceProcAddr(void*, const char*) {
    std::abort();
}
