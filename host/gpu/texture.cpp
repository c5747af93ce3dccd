// Textures: checked against the device, created, filled with zeros.

#include "host/gpu/device_state.h"
#include "host/gpu/error.h"
#include "host/gpu/format.h"
#include "host/gpu/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace tegument::gpu {

namespace detail {

TextureState::~TextureState() {
    device->allocatedBytes -= allocatedBytes;
}

namespace {

std::string described(const TextureDesc& desc) {
    const std::string samples = desc.samples == 1 ? "" : fmt::format(" of {} samples", desc.samples);
    return fmt::format("texture '{}' ({}x{} {}{})", desc.name, desc.width, desc.height, name(desc.format), samples);
}

std::uint32_t fullChain(const TextureDesc& desc) {
    return static_cast<std::uint32_t>(std::bit_width(std::max(desc.width, desc.height)));
}

Result<void> checkShape(const DeviceState& device, const TextureDesc& desc) {
    if (desc.width == 0 || desc.height == 0) return requestError(6010, described(desc) + " has no pixels");
    const std::uint32_t limit = desc.cube ? device.limits.maxImageDimensionCube : device.limits.maxImageDimension2D;
    if (std::max(desc.width, desc.height) > limit)
        return requestError(6010, fmt::format("{} is too large: {} allows {} pixels on a side", described(desc), device.info.name, limit),
                            "a smaller size");
    if (desc.cube && desc.width != desc.height) return requestError(6012, described(desc) + " is a cube map whose faces are not square");
    if (desc.cube && desc.renderTarget)
        return requestError(6012, described(desc) + " is a cube map and a render target", "render the faces one by one and upload them");
    if (desc.mips > fullChain(desc))
        return requestError(
            6012, fmt::format("{} asks for {} mip levels, and {} is its full chain", described(desc), desc.mips, fullChain(desc)));
    if (desc.storage && (!desc.renderTarget || desc.samples != 1 || isDepth(desc.format)))
        return requestError(6012, described(desc) + " is to be written by dispatches and is no colour target of one sample");
    if (desc.samples != 1 && (!desc.renderTarget || desc.mips != 1))
        return requestError(6012, described(desc) + " is multisampled and no render target of one mip level");
    return {};
}

vk::ImageUsageFlags usage(const TextureDesc& desc) {
    vk::ImageUsageFlags flags = vk::ImageUsageFlagBits::eTransferSrc | vk::ImageUsageFlagBits::eTransferDst;
    if (desc.samples == 1) flags |= vk::ImageUsageFlagBits::eSampled;
    if (desc.renderTarget)
        flags |= isDepth(desc.format) ? vk::ImageUsageFlagBits::eDepthStencilAttachment : vk::ImageUsageFlagBits::eColorAttachment;
    if (desc.storage) flags |= vk::ImageUsageFlagBits::eStorage;
    return flags;
}

vk::ImageCreateInfo imageInfo(const TextureDesc& desc) {
    return {
        .flags = desc.cube ? vk::ImageCreateFlagBits::eCubeCompatible : vk::ImageCreateFlags{},
        .imageType = vk::ImageType::e2D,
        .format = vulkanFormat(desc.format),
        .extent = {desc.width, desc.height, 1},
        .mipLevels = desc.mips,
        .arrayLayers = desc.cube ? 6u : 1u,
        .samples = static_cast<vk::SampleCountFlagBits>(desc.samples), // the same numbers
        .tiling = vk::ImageTiling::eOptimal,
        .usage = usage(desc),
        .sharingMode = vk::SharingMode::eExclusive,
        .initialLayout = vk::ImageLayout::eUndefined,
    };
}

/// Format, usage and samples: Vulkan answers for all at once.
Result<void> checkFormat(const DeviceState& device, const TextureDesc& desc) {
    const vk::ImageCreateInfo info = imageInfo(desc);
    vk::ImageFormatProperties properties;
    try {
        properties = device.physical.getImageFormatProperties(info.format, info.imageType, info.tiling, info.usage, info.flags);
    } catch (const vk::FormatNotSupportedError&) {
        return machineError(6011, fmt::format("{}: {} cannot use this format {}", described(desc), device.info.name,
                                              desc.renderTarget ? "as a render target that is sampled" : "as a texture"));
    }
    const auto offered = static_cast<std::uint32_t>(properties.sampleCounts);
    if (!std::has_single_bit(desc.samples) || (offered & desc.samples) == 0)
        return machineError(6016,
                            fmt::format("{}: {} offers {} samples a pixel", described(desc), device.info.name, listedSamples(offered)),
                            "ask for one of these");
    const std::uint64_t bytes = std::uint64_t{desc.width} * desc.height * bytesPerPixel(desc.format) * desc.samples;
    if (bytes > properties.maxResourceSize)
        return requestError(
            6010, fmt::format("{} is too large: {} allows {} bytes", described(desc), device.info.name, properties.maxResourceSize),
            desc.samples > 1 ? "a smaller size, or --samples 1" : "a smaller size");
    return {};
}

vk::raii::ImageView makeView(const TextureState& texture, vk::ImageAspectFlags aspect, bool target) {
    const bool cube = texture.desc.cube && !target;
    return texture.device->device.createImageView({
        .image = *texture.image,
        .viewType = cube ? vk::ImageViewType::eCube : vk::ImageViewType::e2D,
        .format = vulkanFormat(texture.desc.format),
        .subresourceRange = {.aspectMask = aspect,
                             .baseMipLevel = 0,
                             .levelCount = target ? 1 : texture.desc.mips,
                             .baseArrayLayer = 0,
                             .layerCount = cube ? 6u : 1u},
    });
}

/// New memory holds whatever was there before; zeros make every run the same.
void fillWithZeros(TextureState& texture) {
    const vk::ImageSubresourceRange all{.aspectMask = aspects(texture.desc.format),
                                        .baseMipLevel = 0,
                                        .levelCount = VK_REMAINING_MIP_LEVELS,
                                        .baseArrayLayer = 0,
                                        .layerCount = VK_REMAINING_ARRAY_LAYERS};
    submitAndWait(*texture.device, [&](const vk::raii::CommandBuffer& commands) {
        transition(commands, texture, kCopyTarget);
        if (isDepth(texture.desc.format))
            commands.clearDepthStencilImage(*texture.image, texture.track.layout, vk::ClearDepthStencilValue{}, all);
        else
            commands.clearColorImage(*texture.image, texture.track.layout, vk::ClearColorValue{}, all);
    });
}

Result<std::unique_ptr<TextureState>> makeTexture(const std::shared_ptr<DeviceState>& device, const TextureDesc& desc) {
    auto texture = std::make_unique<TextureState>();
    texture->device = device;
    texture->desc = desc;
    vk::raii::Image image = device->device.createImage(imageInfo(desc));
    const vk::MemoryRequirements needs = image.getMemoryRequirements();
    auto memory = allocateDeviceMemory(*device, needs, described(desc));
    if (!memory) return memory.error();
    texture->memory = std::move(*memory);
    texture->allocatedBytes = needs.size;
    device->allocatedBytes += needs.size;
    texture->image = std::move(image);
    texture->image.bindMemory(*texture->memory, 0);
    if (desc.samples == 1)
        texture->sampledView =
            makeView(*texture, isDepth(desc.format) ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor, false);
    if (desc.renderTarget) texture->targetView = makeView(*texture, aspects(desc.format), true);
    fillWithZeros(*texture);
    return texture;
}

} // namespace
} // namespace detail

Texture::Texture() = default;
Texture::Texture(Texture&&) noexcept = default;
Texture& Texture::operator=(Texture&&) noexcept = default;
Texture::~Texture() = default;

const TextureDesc& Texture::desc() const {
    assert(state);
    return state->desc;
}

Texture Texture::shared() const {
    Texture other;
    other.state = state;
    return other;
}

std::uint64_t Texture::bytes() const {
    assert(state);
    std::uint64_t pixels = 0;
    for (std::uint32_t mip = 0; mip < state->desc.mips; ++mip)
        pixels += std::uint64_t{std::max(state->desc.width >> mip, 1u)} * std::max(state->desc.height >> mip, 1u);
    return pixels * bytesPerPixel(state->desc.format) * state->layers() * state->desc.samples;
}

Result<Texture> Device::createTexture(const TextureDesc& asked) {
    TextureDesc desc = asked;
    desc.format = state_->realFormat(asked.format);
    if (const auto fits = detail::checkShape(*state_, desc); !fits) return fits.error();
    if (desc.mips == 0) desc.mips = detail::fullChain(desc);
    return detail::guarded(fmt::format("creating {}", detail::described(desc)), [&]() -> Result<Texture> {
        if (const auto supported = detail::checkFormat(*state_, desc); !supported) return supported.error();
        auto made = detail::makeTexture(state_, desc);
        if (!made) return made.error();
        Texture texture;
        texture.state = std::move(*made);
        return texture;
    });
}

} // namespace tegument::gpu
