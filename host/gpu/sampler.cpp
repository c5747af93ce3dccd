#include "host/gpu/device_state.h"
#include "host/gpu/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::gpu {

namespace detail {

namespace {

vk::Filter filter(Filter value) {
    return value == Filter::Point ? vk::Filter::eNearest : vk::Filter::eLinear;
}

vk::SamplerAddressMode address(Address value) {
    switch (value) {
    case Address::Wrap: return vk::SamplerAddressMode::eRepeat;
    case Address::Mirror: return vk::SamplerAddressMode::eMirroredRepeat;
    case Address::Clamp: return vk::SamplerAddressMode::eClampToEdge;
    case Address::Border: return vk::SamplerAddressMode::eClampToBorder;
    case Address::MirrorOnce: return vk::SamplerAddressMode::eMirrorClampToEdge;
    }
    return vk::SamplerAddressMode::eRepeat;
}

bool uses(const SamplerState& state, Address value) {
    return state.addressU == value || state.addressV == value || state.addressW == value;
}

/// Vulkan's three fixed border colours, or eFloatCustomEXT.
vk::BorderColor borderColor(const std::array<float, 4>& color) {
    if (color == std::array<float, 4>{0, 0, 0, 0}) return vk::BorderColor::eFloatTransparentBlack;
    if (color == std::array<float, 4>{0, 0, 0, 1}) return vk::BorderColor::eFloatOpaqueBlack;
    if (color == std::array<float, 4>{1, 1, 1, 1}) return vk::BorderColor::eFloatOpaqueWhite;
    return vk::BorderColor::eFloatCustomEXT;
}

bool anisotropic(const SamplerState& state, const DeviceState& device) {
    return device.features.anisotropy && state.maxAnisotropy > 1 &&
           (state.minFilter == Filter::Anisotropic || state.magFilter == Filter::Anisotropic);
}

vk::SamplerCreateInfo samplerInfo(const SamplerState& state, const DeviceState& device) {
    // Without mipmapping the largest level of detail is 0.25, not 0: at 0 every sample counts as magnified and minFilter is never used.
    const float maxLod = state.mipmapping ? std::max(state.maxLod, state.minLod) : 0.25f;
    const bool linearMips = state.mipmapping && state.mipFilter != Filter::Point;
    return {
        .magFilter = filter(state.magFilter),
        .minFilter = filter(state.minFilter),
        .mipmapMode = linearMips ? vk::SamplerMipmapMode::eLinear : vk::SamplerMipmapMode::eNearest,
        .addressModeU = address(state.addressU),
        .addressModeV = address(state.addressV),
        .addressModeW = address(state.addressW),
        .mipLodBias = std::clamp(state.mipLodBias, -device.limits.maxSamplerLodBias, device.limits.maxSamplerLodBias),
        .anisotropyEnable = anisotropic(state, device),
        .maxAnisotropy = std::clamp(static_cast<float>(state.maxAnisotropy), 1.0f, std::max(device.limits.maxSamplerAnisotropy, 1.0f)),
        .compareEnable = state.compare.has_value(),
        .compareOp = static_cast<vk::CompareOp>(state.compare.value_or(CompareOp::Never)),
        .minLod = state.mipmapping ? state.minLod : 0.0f,
        .maxLod = maxLod,
    };
}

Result<void> checkSampler(const DeviceState& device, const SamplerState& state) {
    if (uses(state, Address::MirrorOnce) && !device.features.mirrorOnce)
        return machineError(6051, fmt::format("{} has no sampler address mode MirrorOnce", device.info.name));
    const std::array<float, 4>& color = state.borderColor;
    if (uses(state, Address::Border) && borderColor(color) == vk::BorderColor::eFloatCustomEXT && !device.features.customBorderColor)
        return machineError(
            6050, fmt::format("{} has no sampler border colour ({}, {}, {}, {})", device.info.name, color[0], color[1], color[2], color[3]),
            "use transparent black, opaque black or opaque white");
    return {};
}

vk::raii::Sampler makeSampler(const DeviceState& device, const SamplerState& state) {
    vk::SamplerCreateInfo info = samplerInfo(state, device);
    const vk::SamplerCustomBorderColorCreateInfoEXT custom{.customBorderColor = vk::ClearColorValue(state.borderColor),
                                                           .format = vk::Format::eUndefined};
    if (uses(state, Address::Border)) {
        info.borderColor = borderColor(state.borderColor);
        if (info.borderColor == vk::BorderColor::eFloatCustomEXT) info.pNext = &custom;
    }
    return device.device.createSampler(info);
}

// CompareOp is in Vulkan's order.
static_assert(static_cast<int>(vk::CompareOp::eNever) == static_cast<int>(CompareOp::Never));
static_assert(static_cast<int>(vk::CompareOp::eEqual) == static_cast<int>(CompareOp::Equal));
static_assert(static_cast<int>(vk::CompareOp::eGreater) == static_cast<int>(CompareOp::Greater));
static_assert(static_cast<int>(vk::CompareOp::eAlways) == static_cast<int>(CompareOp::Always));

} // namespace
} // namespace detail

Sampler::Sampler() = default;
Sampler::Sampler(Sampler&&) noexcept = default;
Sampler& Sampler::operator=(Sampler&&) noexcept = default;
Sampler::~Sampler() = default;

Result<Sampler> Device::createSampler(const SamplerState& state) {
    if (const auto possible = detail::checkSampler(*state_, state); !possible) return possible.error();
    return detail::guarded("creating a sampler", [&]() -> Result<Sampler> {
        Sampler sampler;
        sampler.state = std::make_unique<detail::SamplerHandle>(detail::SamplerHandle{state_, detail::makeSampler(*state_, state)});
        return sampler;
    });
}

} // namespace tegument::gpu
