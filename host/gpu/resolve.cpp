// Multisampled targets made into textures of one sample, and textures copied whole.

#include "host/gpu/error.h"
#include "host/gpu/format.h"
#include "host/gpu/recorder_state.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::gpu {

namespace detail {

namespace {

bool alike(const TextureDesc& a, const TextureDesc& b) {
    return a.format == b.format && a.width == b.width && a.height == b.height;
}

Error cannot(const char* what, const TextureDesc& from, const TextureDesc& to, std::string hint) {
    const auto described = [](const TextureDesc& desc) {
        return fmt::format("'{}' ({}x{} {}, {} samples)", desc.name, desc.width, desc.height, name(desc.format), desc.samples);
    };
    return requestError(6044, fmt::format("texture {} cannot be {} into {}", described(from), what, described(to)), std::move(hint));
}

Result<void> checkResolve(const TextureDesc& from, const TextureDesc& to) {
    if (from.samples > 1 && to.samples == 1 && alike(from, to) && !isDepth(from.format)) return {};
    return cannot("resolved", from, to, "several samples into one, of one size and one colour format");
}

Result<void> checkCopied(const TextureDesc& from, const TextureDesc& to) {
    if (from.samples == to.samples && from.mips == to.mips && from.cube == to.cube && alike(from, to)) return {};
    return cannot("copied", from, to, "both of one size, one format and as many samples and mip levels");
}

void useForTransfer(RecorderState& recorder, TextureState& from, TextureState& to) {
    flushClear(recorder, from);
    flushClear(recorder, to);
    endScope(recorder);
    use(recorder, from, kCopySource);
    use(recorder, to, kCopyTarget);
    flushBarriers(recorder);
}

void recordCopy(RecorderState& recorder, TextureState& from, TextureState& to) {
    useForTransfer(recorder, from, to);
    std::vector<vk::ImageCopy2> regions;
    for (std::uint32_t mip = 0; mip < from.desc.mips; ++mip) {
        const vk::ImageSubresourceLayers level{.aspectMask = aspects(from.desc.format), .mipLevel = mip, .layerCount = from.layers()};
        const auto side = [mip](std::uint32_t length) { return std::max(length >> mip, 1U); };
        regions.push_back({.srcSubresource = level, .dstSubresource = level, .extent = {side(from.desc.width), side(from.desc.height), 1}});
    }
    recorder.commands.copyImage2({.srcImage = *from.image,
                                  .srcImageLayout = kCopySource.layout,
                                  .dstImage = *to.image,
                                  .dstImageLayout = kCopyTarget.layout,
                                  .regionCount = static_cast<std::uint32_t>(regions.size()),
                                  .pRegions = regions.data()});
}

void recordResolve(RecorderState& recorder, TextureState& from, TextureState& to) {
    useForTransfer(recorder, from, to);
    const vk::ImageSubresourceLayers all{.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1};
    const vk::ImageResolve2 region{.srcSubresource = all, .dstSubresource = all, .extent = {to.desc.width, to.desc.height, 1}};
    recorder.commands.resolveImage2({.srcImage = *from.image,
                                     .srcImageLayout = kCopySource.layout,
                                     .dstImage = *to.image,
                                     .dstImageLayout = kCopyTarget.layout,
                                     .regionCount = 1,
                                     .pRegions = &region});
}

} // namespace
} // namespace detail

Result<void> Recorder::resolve(Texture& from, Texture& to) {
    assert(from.state && to.state);
    if (auto possible = detail::checkResolve(from.desc(), to.desc()); !possible) return possible;
    return detail::guarded("resolving a multisampled target", [&]() -> Result<void> {
        detail::recordResolve(state_, *from.state, *to.state);
        return {};
    });
}

Result<void> Recorder::copy(Texture& from, Texture& to) {
    assert(from.state && to.state);
    if (auto possible = detail::checkCopied(from.desc(), to.desc()); !possible) return possible;
    return detail::guarded("copying a target", [&]() -> Result<void> {
        detail::recordCopy(state_, *from.state, *to.state);
        return {};
    });
}

} // namespace tegument::gpu
