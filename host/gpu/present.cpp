// The swapchain. One picture is under way at a time: the viewer draws when something changed, not as often as it can.

#include "host/gpu/present.h"

#include "host/gpu/device_state.h"
#include "host/gpu/error.h"

#include <algorithm>
#include <limits>

namespace tegument::gpu {

namespace detail {

struct PresenterState {
    std::shared_ptr<DeviceState> device;
    vk::SurfaceFormatKHR format;
    vk::Extent2D extent;
    vk::raii::SwapchainKHR swapchain{nullptr};
    std::vector<vk::Image> images;
    vk::raii::Semaphore acquired{nullptr};
    std::vector<vk::raii::Semaphore> drawn; // one for each image: the display may still hold the last one's

    ~PresenterState() {
        try {
            if (*device->device) device->device.waitIdle();
        } catch (const vk::SystemError&) { // a lost device waits for nothing
        }
    }
};

namespace {

/// Bytes go to the display as they are: an sRGB format would encode them once more.
std::optional<vk::SurfaceFormatKHR> chooseFormat(const DeviceState& device) {
    for (const vk::SurfaceFormatKHR& format : device.physical.getSurfaceFormatsKHR(*device.surface)) {
        const bool bytes = format.format == vk::Format::eB8G8R8A8Unorm || format.format == vk::Format::eR8G8B8A8Unorm;
        if (!bytes || format.colorSpace != vk::ColorSpaceKHR::eSrgbNonlinear) continue;
        const auto features = device.physical.getFormatProperties(format.format).optimalTilingFeatures;
        if (features & vk::FormatFeatureFlagBits::eBlitDst) return format;
    }
    return std::nullopt;
}

vk::Extent2D fitted(const vk::SurfaceCapabilitiesKHR& window, vk::Extent2D wanted) {
    constexpr std::uint32_t kOurChoice = std::numeric_limits<std::uint32_t>::max(); // the window takes the swapchain's size
    if (window.currentExtent.width != kOurChoice) return window.currentExtent;
    return {std::clamp(wanted.width, window.minImageExtent.width, window.maxImageExtent.width),
            std::clamp(wanted.height, window.minImageExtent.height, window.maxImageExtent.height)};
}

vk::CompositeAlphaFlagBitsKHR opaque(const vk::SurfaceCapabilitiesKHR& window) {
    if (window.supportedCompositeAlpha & vk::CompositeAlphaFlagBitsKHR::eOpaque) return vk::CompositeAlphaFlagBitsKHR::eOpaque;
    return vk::CompositeAlphaFlagBitsKHR::eInherit;
}

void makeSwapchain(PresenterState& state, const vk::SurfaceCapabilitiesKHR& window, vk::Extent2D extent) {
    const DeviceState& device = *state.device;
    device.device.waitIdle();
    const std::uint32_t most = window.maxImageCount == 0 ? std::numeric_limits<std::uint32_t>::max() : window.maxImageCount;
    const vk::raii::SwapchainKHR old = std::move(state.swapchain);
    state.swapchain = device.device.createSwapchainKHR({
        .surface = *device.surface,
        .minImageCount = std::min(window.minImageCount + 1, most),
        .imageFormat = state.format.format,
        .imageColorSpace = state.format.colorSpace,
        .imageExtent = extent,
        .imageArrayLayers = 1,
        .imageUsage = vk::ImageUsageFlagBits::eTransferDst,
        .imageSharingMode = vk::SharingMode::eExclusive,
        .preTransform = window.currentTransform,
        .compositeAlpha = opaque(window),
        .presentMode = vk::PresentModeKHR::eFifo, // every device has it, and it never tears
        .clipped = true,
        .oldSwapchain = *old,
    });
    state.extent = extent;
    state.images.clear();
    for (VkImage image : state.swapchain.getImages())
        state.images.emplace_back(image);
    state.drawn.clear();
    for (std::size_t i = 0; i < state.images.size(); ++i)
        state.drawn.push_back(device.device.createSemaphore({}));
}

/// False: the window has no area.
bool fitWindow(PresenterState& state, vk::Extent2D wanted) {
    const vk::SurfaceCapabilitiesKHR window = state.device->physical.getSurfaceCapabilitiesKHR(*state.device->surface);
    const vk::Extent2D extent = fitted(window, wanted);
    if (extent.width == 0 || extent.height == 0) return false;
    if (!*state.swapchain || extent != state.extent) makeSwapchain(state, window, extent);
    return true;
}

vk::ImageMemoryBarrier2 windowBarrier(vk::Image image, const Use& before, const Use& after) {
    return {
        .srcStageMask = before.stages,
        .srcAccessMask = before.writes,
        .dstStageMask = after.stages,
        .dstAccessMask = after.writes,
        .oldLayout = before.layout,
        .newLayout = after.layout,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {.aspectMask = vk::ImageAspectFlagBits::eColor, .levelCount = 1, .layerCount = 1},
    };
}

vk::ImageBlit2 wholeImage(vk::Extent2D from, vk::Extent2D to) {
    const vk::ImageSubresourceLayers layer{.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1};
    const auto corner = [](vk::Extent2D size) {
        return vk::Offset3D{static_cast<std::int32_t>(size.width), static_cast<std::int32_t>(size.height), 1};
    };
    return {.srcSubresource = layer,
            .srcOffsets = std::array{vk::Offset3D{}, corner(from)},
            .dstSubresource = layer,
            .dstOffsets = std::array{vk::Offset3D{}, corner(to)}};
}

/// What was there before is not read: the first layout may be undefined.
constexpr Use kAcquired{.stages = kCopyTarget.stages};
constexpr Use kShown{.layout = vk::ImageLayout::ePresentSrcKHR};

void recordCopy(const PresenterState& state, const vk::raii::CommandBuffer& commands, TextureState& texture, vk::Image image) {
    transition(commands, texture, kCopySource);
    const vk::ImageMemoryBarrier2 before = windowBarrier(image, kAcquired, kCopyTarget);
    recordBarriers(commands, {&before, 1}, {});
    const vk::ImageBlit2 blit = wholeImage({texture.desc.width, texture.desc.height}, state.extent);
    commands.blitImage2({.srcImage = *texture.image,
                         .srcImageLayout = texture.track.layout,
                         .dstImage = image,
                         .dstImageLayout = kCopyTarget.layout,
                         .regionCount = 1,
                         .pRegions = &blit,
                         .filter = vk::Filter::eLinear});
    const vk::ImageMemoryBarrier2 after = windowBarrier(image, kCopyTarget, kShown);
    recordBarriers(commands, {&after, 1}, {});
}

/// Waits for the display's image before the copy, and lets the display wait for the copy.
void submitCopy(PresenterState& state, TextureState& texture, std::uint32_t index) {
    DeviceState& device = *state.device;
    vk::raii::CommandBuffer commands = beginCommands(device);
    recordCopy(state, commands, texture, state.images[index]);
    commands.end();
    const vk::SemaphoreSubmitInfo wait{.semaphore = *state.acquired, .stageMask = kCopyTarget.stages};
    const vk::SemaphoreSubmitInfo signal{.semaphore = *state.drawn[index], .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
    const vk::CommandBufferSubmitInfo buffer{.commandBuffer = *commands};
    const vk::raii::Fence fence = device.device.createFence({});
    device.queue.submit2(vk::SubmitInfo2{.waitSemaphoreInfoCount = 1,
                                         .pWaitSemaphoreInfos = &wait,
                                         .commandBufferInfoCount = 1,
                                         .pCommandBufferInfos = &buffer,
                                         .signalSemaphoreInfoCount = 1,
                                         .pSignalSemaphoreInfos = &signal},
                         *fence);
    static_cast<void>(device.device.waitForFences(*fence, true, std::numeric_limits<std::uint64_t>::max()));
    keepCommands(device, std::move(commands));
}

bool present(PresenterState& state, TextureState& texture) {
    const auto [acquired, index] = state.swapchain.acquireNextImage(std::numeric_limits<std::uint64_t>::max(), *state.acquired);
    submitCopy(state, texture, index);
    const vk::Semaphore drawn = *state.drawn[index];
    const vk::SwapchainKHR swapchain = *state.swapchain;
    const std::uint32_t image = index;
    const vk::Result shown = state.device->queue.presentKHR(
        {.waitSemaphoreCount = 1, .pWaitSemaphores = &drawn, .swapchainCount = 1, .pSwapchains = &swapchain, .pImageIndices = &image});
    if (acquired == vk::Result::eSuboptimalKHR || shown == vk::Result::eSuboptimalKHR) state.extent = vk::Extent2D{}; // made anew next time
    return true;
}

} // namespace
} // namespace detail

Presenter::Presenter(std::unique_ptr<detail::PresenterState> state) : state_(std::move(state)) {}
Presenter::Presenter(Presenter&&) noexcept = default;
Presenter& Presenter::operator=(Presenter&&) noexcept = default;
Presenter::~Presenter() = default;

Result<Presenter> Presenter::create(Device& device) {
    assert(*device.state_->surface);
    return detail::guarded("asking the window for its formats", [&]() -> Result<Presenter> {
        auto state = std::make_unique<detail::PresenterState>();
        state->device = device.state_;
        const auto format = detail::chooseFormat(*device.state_);
        const auto usages = device.state_->physical.getSurfaceCapabilitiesKHR(*device.state_->surface).supportedUsageFlags;
        if (!format || !(usages & vk::ImageUsageFlagBits::eTransferDst))
            return machineError(6062, "the window takes no 8-bit pictures from " + device.info().name, "name another device with --device");
        state->format = *format;
        state->acquired = device.state_->device.createSemaphore({});
        return Presenter(std::move(state));
    });
}

Result<bool> Presenter::show(Texture& texture, std::uint32_t width, std::uint32_t height) {
    assert(texture.state && texture.desc().format == Format::RGBA8);
    if (width == 0 || height == 0) return false;
    return detail::guarded("showing a picture", [&]() -> Result<bool> {
        if (!detail::fitWindow(*state_, {width, height})) return false;
        try {
            return detail::present(*state_, *texture.state);
        } catch (const vk::OutOfDateKHRError&) {
            state_->extent = vk::Extent2D{};
            return false;
        }
    });
}

} // namespace tegument::gpu
