#pragma once
// Memory: one allocation for each resource.

#include "host/support/result.h"

#include <vulkan/vulkan_raii.hpp>

#include <cstddef>
#include <string_view>

namespace tegument::gpu::detail {

struct DeviceState;

/// A mapped, coherent buffer.
struct HostBuffer {
    vk::raii::DeviceMemory memory{nullptr};
    vk::raii::Buffer buffer{nullptr};
    std::byte* data = nullptr;
    vk::DeviceSize size = 0;
};

enum class HostAccess { Write, Read };

[[nodiscard]] HostBuffer makeHostBuffer(const DeviceState& device, vk::DeviceSize size, vk::BufferUsageFlags usage, HostAccess access);

/// Device-local memory for `what`. Refused before the driver is asked when it cannot fit: TG6008 with the sizes.
[[nodiscard]] Result<vk::raii::DeviceMemory> allocateDeviceMemory(const DeviceState& device, const vk::MemoryRequirements& needs,
                                                                  std::string_view what);

} // namespace tegument::gpu::detail
