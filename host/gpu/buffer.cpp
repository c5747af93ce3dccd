// Buffers: device-local, filled and read through staging memory.

#include "host/gpu/device_state.h"
#include "host/gpu/error.h"
#include "host/gpu/memory.h"
#include "host/gpu/recorder_state.h"

#include <fmt/format.h>

#include <cstring>

namespace tegument::gpu {

namespace detail {

BufferState::~BufferState() {
    device->allocatedBytes -= allocatedBytes;
}

namespace {

vk::BufferUsageFlags usageFlags(BufferUsage usage) {
    const vk::BufferUsageFlags copies = vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst;
    switch (usage) {
    case BufferUsage::Vertex: return copies | vk::BufferUsageFlagBits::eVertexBuffer;
    case BufferUsage::Index: return copies | vk::BufferUsageFlagBits::eIndexBuffer;
    case BufferUsage::Storage: return copies | vk::BufferUsageFlagBits::eStorageBuffer;
    }
    return copies;
}

void transitionBuffer(const vk::raii::CommandBuffer& commands, BufferState& buffer, const Use& use) {
    if (const auto dependency = advance(buffer.track, use)) {
        const vk::BufferMemoryBarrier2 barrier = bufferBarrier(buffer, *dependency, use);
        recordBarriers(commands, {}, {&barrier, 1});
    }
}

Use withoutLayout(Use use) {
    use.layout = vk::ImageLayout::eUndefined;
    return use;
}

void fill(DeviceState& device, BufferState& buffer, std::span<const std::byte> bytes) {
    const HostBuffer staging = makeHostBuffer(device, bytes.size(), vk::BufferUsageFlagBits::eTransferSrc, HostAccess::Write);
    std::memcpy(staging.data, bytes.data(), bytes.size());
    submitAndWait(device, [&](const vk::raii::CommandBuffer& commands) {
        transitionBuffer(commands, buffer, withoutLayout(kCopyTarget));
        commands.copyBuffer(*staging.buffer, *buffer.buffer, vk::BufferCopy{.size = bytes.size()});
    });
}

Result<std::unique_ptr<BufferState>> makeBuffer(const std::shared_ptr<DeviceState>& device, BufferUsage usage, std::uint64_t size) {
    auto buffer = std::make_unique<BufferState>();
    buffer->device = device;
    buffer->usage = usage;
    buffer->bytes = size;
    vk::raii::Buffer handle =
        device->device.createBuffer({.size = size, .usage = usageFlags(usage), .sharingMode = vk::SharingMode::eExclusive});
    const vk::MemoryRequirements needs = handle.getMemoryRequirements();
    auto memory = allocateDeviceMemory(*device, needs, fmt::format("a buffer of {} bytes", size));
    if (!memory) return memory.error();
    buffer->memory = std::move(*memory);
    buffer->allocatedBytes = needs.size;
    device->allocatedBytes += needs.size;
    buffer->buffer = std::move(handle);
    buffer->buffer.bindMemory(*buffer->memory, 0);
    return buffer;
}

} // namespace
} // namespace detail

Buffer::Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;
Buffer::~Buffer() = default;

std::uint64_t Buffer::bytes() const {
    assert(state);
    return state->bytes;
}

Result<Buffer> Device::createBuffer(BufferUsage usage, std::span<const std::byte> bytes) {
    if (bytes.empty()) return detail::requestError(6015, "a buffer of 0 bytes was asked for");
    if (usage == BufferUsage::Storage && bytes.size() > state_->limits.maxStorageBufferRange)
        return detail::requestError(6015, fmt::format("a storage buffer of {} bytes is too large: {} allows {}", bytes.size(),
                                                      state_->info.name, state_->limits.maxStorageBufferRange));
    return detail::guarded(fmt::format("creating a buffer of {} bytes", bytes.size()), [&]() -> Result<Buffer> {
        auto made = detail::makeBuffer(state_, usage, bytes.size());
        if (!made) return made.error();
        detail::fill(*state_, **made, bytes);
        Buffer buffer;
        buffer.state = std::move(*made);
        return buffer;
    });
}

Result<std::vector<std::byte>> Device::readback(Buffer& buffer) {
    assert(buffer.state);
    detail::BufferState& state = *buffer.state;
    if (const auto idle = detail::checkIdle(*state_, state.track, "a buffer"); !idle) return idle.error();
    return detail::guarded(fmt::format("reading back a buffer of {} bytes", state.bytes), [&]() -> Result<std::vector<std::byte>> {
        const detail::HostBuffer staging =
            detail::makeHostBuffer(*state_, state.bytes, vk::BufferUsageFlagBits::eTransferDst, detail::HostAccess::Read);
        detail::submitAndWait(*state_, [&](const vk::raii::CommandBuffer& commands) {
            detail::transitionBuffer(commands, state, detail::withoutLayout(detail::kCopySource));
            commands.copyBuffer(*state.buffer, *staging.buffer, vk::BufferCopy{.size = state.bytes});
            detail::recordHostBarrier(commands);
        });
        return std::vector<std::byte>(staging.data, staging.data + staging.size);
    });
}

} // namespace tegument::gpu
