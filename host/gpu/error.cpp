#include "host/gpu/error.h"

#include <fmt/format.h>

namespace tegument::gpu::detail {

Error vulkanError(const vk::SystemError& error, std::string_view doing) {
    const auto result = static_cast<vk::Result>(error.code().value());
    const std::string text = fmt::format("Vulkan reported {} while {}", "VK_" + vk::to_string(result), doing);
    switch (result) {
    case vk::Result::eErrorDeviceLost:
        return machineError(6007, text,
                            "the driver stopped the work, for example because one submission took too long: try a smaller size");
    case vk::Result::eErrorOutOfHostMemory:
    case vk::Result::eErrorOutOfDeviceMemory: return machineError(6008, text, "use smaller targets or fewer of them");
    default: return machineError(6006, text);
    }
}

} // namespace tegument::gpu::detail
