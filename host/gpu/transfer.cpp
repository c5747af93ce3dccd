// Copies between textures and the host, each submitted on its own.

#include "host/gpu/device_state.h"
#include "host/gpu/error.h"
#include "host/gpu/format.h"
#include "host/gpu/memory.h"
#include "host/gpu/part.h"
#include "host/gpu/recorder_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace tegument::gpu {

namespace detail {
namespace {

/// One mip of one layer, as a copy sees it.
vk::BufferImageCopy2 region(const TextureState& texture, std::uint32_t mip, std::uint32_t layer) {
    return {
        .imageSubresource = {.aspectMask = isDepth(texture.desc.format) ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor,
                             .mipLevel = mip,
                             .baseArrayLayer = layer,
                             .layerCount = 1},
        .imageExtent = {std::max(texture.desc.width >> mip, 1u), std::max(texture.desc.height >> mip, 1u), 1},
    };
}

std::uint64_t copiedBytes(const TextureState& texture, const vk::BufferImageCopy2& region) {
    return std::uint64_t{region.imageExtent.width} * region.imageExtent.height * copiedBytesPerPixel(texture.desc.format);
}

Result<void> checkCopy(const DeviceState& device, const TextureState& texture, std::uint32_t mip, std::uint32_t layer) {
    if (mip >= texture.desc.mips || layer >= texture.layers())
        return requestError(6014, fmt::format("texture '{}' has no mip {} of layer {}: it has {} mips and {} layers", texture.desc.name,
                                              mip, layer, texture.desc.mips, texture.layers()));
    if (texture.desc.samples != 1)
        return requestError(6017, fmt::format("texture '{}' is multisampled and cannot be copied to or from the host", texture.desc.name),
                            "resolve it into a texture of one sample");
    return checkIdle(device, texture.track, fmt::format("texture '{}'", texture.desc.name));
}

std::vector<std::byte> copyOut(DeviceState& device, TextureState& texture, const vk::BufferImageCopy2& region) {
    const HostBuffer staging =
        makeHostBuffer(device, copiedBytes(texture, region), vk::BufferUsageFlagBits::eTransferDst, HostAccess::Read);
    submitAndWait(device, [&](const vk::raii::CommandBuffer& commands) {
        transition(commands, texture, kCopySource);
        commands.copyImageToBuffer2({.srcImage = *texture.image,
                                     .srcImageLayout = texture.track.layout,
                                     .dstBuffer = *staging.buffer,
                                     .regionCount = 1,
                                     .pRegions = &region});
        recordHostBarrier(commands);
    });
    return {staging.data, staging.data + staging.size};
}

/// Vulkan has no depths outside of 0 to 1 without an extension.
bool areDepths(std::span<const std::byte> texels) {
    for (std::size_t at = 0; at + sizeof(float) <= texels.size(); at += sizeof(float)) {
        float depth = 0;
        std::memcpy(&depth, texels.data() + at, sizeof depth);
        if (!(depth >= 0 && depth <= 1)) return false;
    }
    return true;
}

/// Texels of one mip; all of it where no part is given.
Result<std::vector<std::byte>> readTexels(DeviceState& device, TextureState& texture, const TexelRect* part, std::uint32_t mip,
                                          std::uint32_t layer) {
    if (const auto possible = checkCopy(device, texture, mip, layer); !possible) return possible.error();
    vk::BufferImageCopy2 copied = region(texture, mip, layer);
    const auto inside = [](std::uint32_t first, std::uint32_t count, std::uint32_t all) {
        return count > 0 && count <= all && first <= all - count;
    };
    if (part && (!inside(part->x, part->width, copied.imageExtent.width) || !inside(part->y, part->height, copied.imageExtent.height)))
        return requestError(6014, fmt::format("{} x {} texels from {}, {} on are not all in mip {} of texture '{}'", part->width,
                                              part->height, part->x, part->y, mip, texture.desc.name));
    if (part) {
        copied.imageOffset = vk::Offset3D{static_cast<std::int32_t>(part->x), static_cast<std::int32_t>(part->y), 0};
        copied.imageExtent = vk::Extent3D{part->width, part->height, 1};
    }
    return guarded(fmt::format("reading back texture '{}'", texture.desc.name), [&]() -> Result<std::vector<std::byte>> {
        auto texels = copyOut(device, texture, copied);
        if (isDepth(texture.desc.format)) return depthAsFloats(texture.desc.format, texels);
        return texels;
    });
}

} // namespace
} // namespace detail

Result<void> Device::upload(Texture& texture, std::span<const std::byte> pixels, std::uint32_t mip, std::uint32_t layer) {
    assert(texture.state);
    detail::TextureState& state = *texture.state;
    if (const auto possible = detail::checkCopy(*state_, state, mip, layer); !possible) return possible.error();
    if (isDepth(state.desc.format) && (state.desc.format != Format::D32F || !detail::areDepths(pixels)))
        return detail::requestError(6013,
                                    fmt::format("texture '{}' is a depth texture: what is uploaded to it must be floats of 0 to 1, and its "
                                                "format D32F",
                                                state.desc.name));
    const vk::BufferImageCopy2 region = detail::region(state, mip, layer);
    if (pixels.size() != detail::copiedBytes(state, region))
        return detail::requestError(6013, fmt::format("texture '{}' takes {} bytes in mip {}, and {} were given", state.desc.name,
                                                      detail::copiedBytes(state, region), mip, pixels.size()));
    return detail::guarded(fmt::format("uploading texture '{}'", state.desc.name), [&]() -> Result<void> {
        const detail::HostBuffer staging =
            detail::makeHostBuffer(*state_, pixels.size(), vk::BufferUsageFlagBits::eTransferSrc, detail::HostAccess::Write);
        std::memcpy(staging.data, pixels.data(), pixels.size());
        detail::submitAndWait(*state_, [&](const vk::raii::CommandBuffer& commands) {
            detail::transition(commands, state, detail::kCopyTarget);
            commands.copyBufferToImage2({.srcBuffer = *staging.buffer,
                                         .dstImage = *state.image,
                                         .dstImageLayout = state.track.layout,
                                         .regionCount = 1,
                                         .pRegions = &region});
        });
        return {};
    });
}

Result<std::vector<std::byte>> Device::readback(Texture& texture, std::uint32_t mip, std::uint32_t layer) {
    assert(texture.state);
    return detail::readTexels(*state_, *texture.state, nullptr, mip, layer);
}

Result<std::vector<std::byte>> readbackPart(Texture& texture, const TexelRect& part, std::uint32_t mip, std::uint32_t layer) {
    assert(texture.state);
    return detail::readTexels(*texture.state->device, *texture.state, &part, mip, layer);
}

} // namespace tegument::gpu
