// Submission, and barriers as Vulkan writes them.

#include "host/gpu/device_state.h"
#include "host/gpu/format.h"

#include <limits>

namespace tegument::gpu::detail {

namespace {

vk::raii::CommandBuffer takeCommands(DeviceState& device) {
    if (!device.idleCommands.empty()) {
        vk::raii::CommandBuffer commands = std::move(device.idleCommands.back());
        device.idleCommands.pop_back();
        return commands;
    }
    const vk::CommandBufferAllocateInfo info{
        .commandPool = *device.commandPool, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1};
    return std::move(device.device.allocateCommandBuffers(info).front());
}

} // namespace

vk::raii::CommandBuffer beginCommands(DeviceState& device) {
    vk::raii::CommandBuffer commands = takeCommands(device);
    commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    return commands;
}

void keepCommands(DeviceState& device, vk::raii::CommandBuffer commands) noexcept {
    try {
        commands.reset();
        device.idleCommands.push_back(std::move(commands));
    } catch (const std::exception&) { // freed then; the next submission makes its own
    }
}

void submitAndWait(DeviceState& device, const vk::raii::CommandBuffer& commands) {
    commands.end();
    const vk::raii::Fence fence = device.device.createFence({});
    const vk::CommandBufferSubmitInfo buffer{.commandBuffer = *commands};
    const vk::SubmitInfo2 submit{.commandBufferInfoCount = 1, .pCommandBufferInfos = &buffer};
    device.queue.submit2(submit, *fence);
    // No time limit: a software device may need minutes for a frame, and a GPU that hangs reports itself lost.
    const auto result = device.device.waitForFences(*fence, true, std::numeric_limits<std::uint64_t>::max());
    assert(result == vk::Result::eSuccess);
    static_cast<void>(result);
}

void submitAndWait(DeviceState& device, const std::function<void(const vk::raii::CommandBuffer&)>& record) {
    vk::raii::CommandBuffer commands = beginCommands(device);
    record(commands);
    submitAndWait(device, commands);
    keepCommands(device, std::move(commands));
}

vk::ImageMemoryBarrier2 imageBarrier(const TextureState& texture, const Dependency& dependency, const Use& use) {
    return {
        .srcStageMask = dependency.stages,
        .srcAccessMask = dependency.access,
        .dstStageMask = use.stages,
        .dstAccessMask = use.reads | use.writes,
        .oldLayout = dependency.layout,
        .newLayout = use.layout,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = *texture.image,
        .subresourceRange = {.aspectMask = aspects(texture.desc.format),
                             .baseMipLevel = 0,
                             .levelCount = VK_REMAINING_MIP_LEVELS,
                             .baseArrayLayer = 0,
                             .layerCount = VK_REMAINING_ARRAY_LAYERS},
    };
}

vk::BufferMemoryBarrier2 bufferBarrier(const BufferState& buffer, const Dependency& dependency, const Use& use) {
    return {
        .srcStageMask = dependency.stages,
        .srcAccessMask = dependency.access,
        .dstStageMask = use.stages,
        .dstAccessMask = use.reads | use.writes,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .buffer = *buffer.buffer,
        .offset = 0,
        .size = VK_WHOLE_SIZE,
    };
}

void recordBarriers(const vk::raii::CommandBuffer& commands, std::span<const vk::ImageMemoryBarrier2> images,
                    std::span<const vk::BufferMemoryBarrier2> buffers) {
    if (images.empty() && buffers.empty()) return;
    commands.pipelineBarrier2({
        .bufferMemoryBarrierCount = static_cast<std::uint32_t>(buffers.size()),
        .pBufferMemoryBarriers = buffers.data(),
        .imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size()),
        .pImageMemoryBarriers = images.data(),
    });
}

void recordHostBarrier(const vk::raii::CommandBuffer& commands) {
    constexpr vk::MemoryBarrier2 kToHost{
        .srcStageMask = vk::PipelineStageFlagBits2::eAllTransfer,
        .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
        .dstStageMask = vk::PipelineStageFlagBits2::eHost,
        .dstAccessMask = vk::AccessFlagBits2::eHostRead,
    };
    commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &kToHost});
}

void transition(const vk::raii::CommandBuffer& commands, TextureState& texture, const Use& use) {
    if (const auto dependency = advance(texture.track, use)) {
        const vk::ImageMemoryBarrier2 barrier = imageBarrier(texture, *dependency, use);
        recordBarriers(commands, {&barrier, 1}, {});
    }
}

} // namespace tegument::gpu::detail
