// Mip chains, each level blitted from the one above with a linear filter: for even sizes the mean of two by two texels.

#include "host/gpu/error.h"
#include "host/gpu/format.h"
#include "host/gpu/recorder_state.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::gpu {

namespace detail {

namespace {

bool canBlit(const DeviceState& device, Format format) {
    constexpr vk::FormatFeatureFlags kNeeded =
        vk::FormatFeatureFlagBits::eBlitSrc | vk::FormatFeatureFlagBits::eBlitDst | vk::FormatFeatureFlagBits::eSampledImageFilterLinear;
    return (device.physical.getFormatProperties(vulkanFormat(format)).optimalTilingFeatures & kNeeded) == kNeeded;
}

vk::ImageSubresourceLayers level(const TextureState& texture, std::uint32_t mip) {
    return {.aspectMask = vk::ImageAspectFlagBits::eColor, .mipLevel = mip, .baseArrayLayer = 0, .layerCount = texture.layers()};
}

vk::Offset3D farCorner(const TextureState& texture, std::uint32_t mip) {
    return {static_cast<std::int32_t>(std::max(texture.desc.width >> mip, 1u)),
            static_cast<std::int32_t>(std::max(texture.desc.height >> mip, 1u)), 1};
}

/// From copy target to copy source.
void finishLevel(const vk::raii::CommandBuffer& commands, const TextureState& texture, std::uint32_t mip) {
    vk::ImageMemoryBarrier2 barrier = imageBarrier(texture, {kCopyTarget.stages, kCopyTarget.writes, kCopyTarget.layout}, kCopySource);
    barrier.subresourceRange.baseMipLevel = mip;
    barrier.subresourceRange.levelCount = 1;
    recordBarriers(commands, {&barrier, 1}, {});
}

void blitLevel(const vk::raii::CommandBuffer& commands, const TextureState& texture, std::uint32_t mip) {
    const vk::ImageBlit2 region{
        .srcSubresource = level(texture, mip - 1),
        .srcOffsets = {{vk::Offset3D{}, farCorner(texture, mip - 1)}},
        .dstSubresource = level(texture, mip),
        .dstOffsets = {{vk::Offset3D{}, farCorner(texture, mip)}},
    };
    commands.blitImage2({.srcImage = *texture.image,
                         .srcImageLayout = kCopySource.layout,
                         .dstImage = *texture.image,
                         .dstImageLayout = kCopyTarget.layout,
                         .regionCount = 1,
                         .pRegions = &region,
                         .filter = vk::Filter::eLinear});
}

void recordMips(RecorderState& recorder, TextureState& texture) {
    flushClear(recorder, texture);
    endScope(recorder);
    use(recorder, texture, kCopyTarget);
    flushBarriers(recorder);
    for (std::uint32_t mip = 1; mip < texture.desc.mips; ++mip) {
        finishLevel(recorder.commands, texture, mip - 1);
        blitLevel(recorder.commands, texture, mip);
    }
    finishLevel(recorder.commands, texture, texture.desc.mips - 1);
    // Every level was written by a copy and has become a copy source.
    texture.track = Track{
        .layout = kCopySource.layout, .writeStages = kCopySource.stages, .readStages = kCopySource.stages, .readAccess = kCopySource.reads};
}

} // namespace
} // namespace detail

Result<void> Recorder::generateMips(Texture& texture) {
    assert(texture.state);
    detail::TextureState& state = *texture.state;
    if (state.desc.mips == 1) return {};
    if (isDepth(state.desc.format) || !detail::canBlit(state_.device, state.desc.format))
        return detail::requestError(6040, fmt::format("texture '{}': {} cannot filter {} into mip levels", state.desc.name,
                                                      state_.device.info.name, name(state.desc.format)));
    return detail::guarded("generating mip levels", [&]() -> Result<void> {
        detail::recordMips(state_, state);
        return {};
    });
}

} // namespace tegument::gpu
