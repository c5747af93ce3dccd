#include "host/gpu/recorder_state.h"

#include "host/gpu/error.h"
#include "host/gpu/format.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::gpu::detail {

RecorderState::RecorderState(DeviceState& deviceState) : device(deviceState), commands(beginCommands(deviceState)) {
    device.bytes.reset();
    device.descriptors.reset();
    device.timestamps.reset();
    device.recording = this;
}

RecorderState::~RecorderState() {
    device.recording = nullptr;
    if (submitted) {
        keepCommands(device, std::move(commands));
        return;
    }
    for (const auto& [track, old] : before)
        *track = old;
}

Result<void> checkIdle(const DeviceState& device, const Track& track, std::string_view what) {
    if (!device.recording || !device.recording->before.contains(const_cast<Track*>(&track))) return {};
    return requestError(6043, fmt::format("{} cannot be copied to or from the host: the frame being recorded uses it", what));
}

void use(RecorderState& recorder, TextureState& texture, const Use& use) {
    recorder.before.try_emplace(&texture.track, texture.track);
    if (const auto dependency = advance(texture.track, use)) recorder.imageBarriers.push_back(imageBarrier(texture, *dependency, use));
}

void use(RecorderState& recorder, BufferState& buffer, const Use& use) {
    recorder.before.try_emplace(&buffer.track, buffer.track);
    if (const auto dependency = advance(buffer.track, use)) recorder.bufferBarriers.push_back(bufferBarrier(buffer, *dependency, use));
}

void endScope(RecorderState& recorder) {
    if (!recorder.scope) return;
    recorder.commands.endRendering();
    recorder.scope.reset();
}

void flushBarriers(RecorderState& recorder) {
    if (recorder.imageBarriers.empty() && recorder.bufferBarriers.empty()) return;
    endScope(recorder);
    recordBarriers(recorder.commands, recorder.imageBarriers, recorder.bufferBarriers);
    recorder.imageBarriers.clear();
    recorder.bufferBarriers.clear();
}

namespace {

std::optional<PendingClear> takeClear(RecorderState& recorder, const TextureState& texture) {
    const auto found = std::ranges::find(recorder.clears, &texture, &PendingClear::texture);
    if (found == recorder.clears.end()) return std::nullopt;
    const PendingClear clear = *found;
    recorder.clears.erase(found);
    return clear;
}

void recordClear(RecorderState& recorder, const PendingClear& clear) {
    const auto range = [](vk::ImageAspectFlags aspect) {
        return vk::ImageSubresourceRange{
            .aspectMask = aspect, .baseMipLevel = 0, .levelCount = 1, .baseArrayLayer = 0, .layerCount = VK_REMAINING_ARRAY_LAYERS};
    };
    const vk::Image image = *clear.texture->image;
    const vk::ImageLayout layout = clear.texture->track.layout;
    if (clear.color) {
        const vk::ClearColorValue value(*clear.color);
        recorder.commands.clearColorImage(image, layout, value, range(vk::ImageAspectFlagBits::eColor));
        return;
    }
    vk::ImageAspectFlags aspect;
    if (clear.depth) aspect |= vk::ImageAspectFlagBits::eDepth;
    if (clear.stencil) aspect |= vk::ImageAspectFlagBits::eStencil;
    const vk::ClearDepthStencilValue value{.depth = clear.depth.value_or(0), .stencil = clear.stencil.value_or(0)};
    recorder.commands.clearDepthStencilImage(image, layout, value, range(aspect));
}

vk::RenderingAttachmentInfo attachment(const TextureState& texture, bool clear, const vk::ClearValue& value) {
    return {
        .imageView = *texture.targetView,
        .imageLayout = isDepth(texture.desc.format) ? kDepthTarget.layout : kColorTarget.layout,
        .loadOp = clear ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad,
        .storeOp = vk::AttachmentStoreOp::eStore,
        .clearValue = value,
    };
}

vk::RenderingAttachmentInfo colorAttachment(RecorderState& recorder, const TextureState& texture) {
    const auto clear = takeClear(recorder, texture);
    vk::ClearValue value;
    if (clear) value.color = vk::ClearColorValue(*clear->color);
    return attachment(texture, clear.has_value(), value);
}

/// Depth and stencil, of which each may be cleared alone.
std::array<vk::RenderingAttachmentInfo, 2> depthAttachments(RecorderState& recorder, const TextureState& texture) {
    const auto clear = takeClear(recorder, texture).value_or(PendingClear{});
    vk::ClearValue value;
    value.depthStencil = vk::ClearDepthStencilValue{.depth = clear.depth.value_or(0), .stencil = clear.stencil.value_or(0)};
    return {attachment(texture, clear.depth.has_value(), value), attachment(texture, clear.stencil.has_value(), value)};
}

vk::Extent2D extent(const Scope& scope) {
    const TextureState* target = scope.colors.empty() ? scope.depth : scope.colors.front();
    assert(target); // a pipeline has at least one
    return {target->desc.width, target->desc.height};
}

/// Direct3D's viewport: y up, which Vulkan spells with a negative height from the bottom edge.
void setViewport(const vk::raii::CommandBuffer& commands, vk::Extent2D size) {
    const auto width = static_cast<float>(size.width);
    const auto height = static_cast<float>(size.height);
    commands.setViewport(0, vk::Viewport{.x = 0, .y = height, .width = width, .height = -height, .minDepth = 0, .maxDepth = 1});
    commands.setScissor(0, vk::Rect2D{.offset = {0, 0}, .extent = size});
}

void beginRendering(RecorderState& recorder, const Scope& scope) {
    std::vector<vk::RenderingAttachmentInfo> colors;
    for (const TextureState* color : scope.colors)
        colors.push_back(colorAttachment(recorder, *color));
    std::array<vk::RenderingAttachmentInfo, 2> depthStencil;
    if (scope.depth) depthStencil = depthAttachments(recorder, *scope.depth);
    const bool stencil = scope.depth && hasStencil(scope.depth->desc.format);
    const vk::Extent2D size = extent(scope);
    recorder.commands.beginRendering({
        .renderArea = {.offset = {0, 0}, .extent = size},
        .layerCount = 1,
        .colorAttachmentCount = static_cast<std::uint32_t>(colors.size()),
        .pColorAttachments = colors.data(),
        .pDepthAttachment = scope.depth ? &depthStencil[0] : nullptr,
        .pStencilAttachment = stencil ? &depthStencil[1] : nullptr,
    });
    setViewport(recorder.commands, size);
}

bool hasPendingClear(const RecorderState& recorder, const TextureState* texture) {
    return std::ranges::find(recorder.clears, texture, &PendingClear::texture) != recorder.clears.end();
}

bool continues(const RecorderState& recorder, const Scope& wanted) {
    if (recorder.scope != wanted || !recorder.imageBarriers.empty() || !recorder.bufferBarriers.empty()) return false;
    return std::ranges::none_of(wanted.colors, [&](const TextureState* color) { return hasPendingClear(recorder, color); }) &&
           !hasPendingClear(recorder, wanted.depth);
}

} // namespace

void flushClear(RecorderState& recorder, TextureState& texture) {
    const auto clear = takeClear(recorder, texture);
    if (!clear) return;
    endScope(recorder);
    use(recorder, texture, kCopyTarget);
    flushBarriers(recorder);
    recordClear(recorder, *clear);
}

void flushAllClears(RecorderState& recorder) {
    while (!recorder.clears.empty())
        flushClear(recorder, *recorder.clears.back().texture);
}

void openScope(RecorderState& recorder, const Scope& wanted) {
    if (continues(recorder, wanted)) return;
    endScope(recorder);
    for (TextureState* color : wanted.colors)
        use(recorder, *color, kColorTarget);
    if (wanted.depth) use(recorder, *wanted.depth, kDepthTarget);
    flushBarriers(recorder);
    beginRendering(recorder, wanted);
    recorder.scope = wanted;
    ++recorder.scopesOpened;
}

} // namespace tegument::gpu::detail
