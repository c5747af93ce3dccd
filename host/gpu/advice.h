#pragma once
// What brings Vulkan to this system.

namespace tegument::gpu::detail {

struct Advice {
    const char* loader; // its file
    const char* toGetLoader;
    const char* toGetDriver;
};
[[nodiscard]] Advice advice();

} // namespace tegument::gpu::detail
