#include "host/gpu/memory.h"

#include "host/gpu/device_state.h"
#include "host/gpu/error.h"

#include <fmt/format.h>

namespace tegument::gpu::detail {

namespace {

double mebibytes(vk::DeviceSize bytes) {
    return static_cast<double>(bytes) / (1024.0 * 1024.0);
}

/// The first memory type with all `wanted` properties, else the first with all `needed` ones. Vulkan orders types by speed.
std::optional<std::uint32_t> memoryType(const DeviceState& device, std::uint32_t allowed, vk::MemoryPropertyFlags wanted,
                                        vk::MemoryPropertyFlags needed) {
    const vk::PhysicalDeviceMemoryProperties memory = device.physical.getMemoryProperties();
    for (const vk::MemoryPropertyFlags flags : {wanted, needed})
        for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
            if ((allowed >> i & 1u) != 0 && (memory.memoryTypes[i].propertyFlags & flags) == flags) return i;
    return std::nullopt;
}

Error outOfMemory(const DeviceState& device, vk::DeviceSize size, std::string_view what, std::string_view limit) {
    return machineError(6008,
                        fmt::format("not enough GPU memory for {}: it needs {:.1f} MiB, {}; {:.1f} MiB are in use by textures and buffers",
                                    what, mebibytes(size), limit, mebibytes(device.allocatedBytes)),
                        "use smaller targets or fewer of them");
}

std::string_view fitLimit(const DeviceState& device, vk::DeviceSize size, vk::DeviceSize heap) {
    if (size > device.maxAllocationSize) return "more than one allocation may have";
    if (device.allocatedBytes + size > heap) return "more than the memory heap has left";
    return {};
}

} // namespace

HostBuffer makeHostBuffer(const DeviceState& device, vk::DeviceSize size, vk::BufferUsageFlags usage, HostAccess access) {
    HostBuffer host;
    host.size = size;
    vk::raii::Buffer buffer = device.device.createBuffer({.size = size, .usage = usage, .sharingMode = vk::SharingMode::eExclusive});
    const vk::MemoryRequirements needs = buffer.getMemoryRequirements();
    const vk::MemoryPropertyFlags needed = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
    // Reading uncached memory is slower by an order of magnitude on discrete GPUs.
    const vk::MemoryPropertyFlags wanted = access == HostAccess::Read ? needed | vk::MemoryPropertyFlagBits::eHostCached : needed;
    const auto type = memoryType(device, needs.memoryTypeBits, wanted, needed);
    assert(type && "Vulkan guarantees a host-visible, coherent type for buffers");
    host.memory = device.device.allocateMemory({.allocationSize = needs.size, .memoryTypeIndex = *type});
    host.buffer = std::move(buffer);
    host.buffer.bindMemory(*host.memory, 0);
    host.data = static_cast<std::byte*>(host.memory.mapMemory(0, size));
    return host;
}

Result<vk::raii::DeviceMemory> allocateDeviceMemory(const DeviceState& device, const vk::MemoryRequirements& needs, std::string_view what) {
    const auto type = memoryType(device, needs.memoryTypeBits, vk::MemoryPropertyFlagBits::eDeviceLocal, {});
    assert(type && "Vulkan gives every resource at least one memory type");
    const vk::PhysicalDeviceMemoryProperties memory = device.physical.getMemoryProperties();
    const vk::DeviceSize heap = memory.memoryHeaps[memory.memoryTypes[*type].heapIndex].size;
    if (const auto limit = fitLimit(device, needs.size, heap); !limit.empty()) return outOfMemory(device, needs.size, what, limit);
    try {
        return device.device.allocateMemory({.allocationSize = needs.size, .memoryTypeIndex = *type});
    } catch (const vk::OutOfDeviceMemoryError&) {
        return outOfMemory(device, needs.size, what, "which the driver refused");
    } catch (const vk::OutOfHostMemoryError&) {
        return outOfMemory(device, needs.size, what, "which the driver refused");
    }
}

} // namespace tegument::gpu::detail
