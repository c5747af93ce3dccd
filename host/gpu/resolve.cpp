// Multisampled targets made into textures of one sample.

#include "host/gpu/error.h"
#include "host/gpu/recorder_state.h"

#include <fmt/format.h>

namespace tegument::gpu {

namespace detail {

namespace {

Result<void> checkResolve(const TextureDesc& from, const TextureDesc& to) {
    const bool counts = from.samples > 1 && to.samples == 1;
    const bool alike = from.format == to.format && from.width == to.width && from.height == to.height;
    if (counts && alike && !isDepth(from.format)) return {};
    const auto described = [](const TextureDesc& desc) {
        return fmt::format("'{}' ({}x{} {}, {} samples)", desc.name, desc.width, desc.height, name(desc.format), desc.samples);
    };
    return requestError(6044, fmt::format("texture {} cannot be resolved into {}", described(from), described(to)),
                        "several samples into one, of one size and one colour format");
}

void recordResolve(RecorderState& recorder, TextureState& from, TextureState& to) {
    flushClear(recorder, from);
    flushClear(recorder, to);
    endScope(recorder);
    use(recorder, from, kCopySource);
    use(recorder, to, kCopyTarget);
    flushBarriers(recorder);
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

} // namespace tegument::gpu
