#include "host/gpu/format.h"

#include <cstring>

namespace tegument::gpu {

namespace {

/// In the order of the enumeration.
constexpr std::array kFormats = {
    vk::Format::eR8Unorm,
    vk::Format::eR8G8Unorm,
    vk::Format::eR8G8B8A8Unorm,
    vk::Format::eB8G8R8A8Unorm,
    vk::Format::eR8G8B8A8Srgb,
    vk::Format::eR16G16B16A16Unorm,
    vk::Format::eA2B10G10R10UnormPack32, // red in the low bits, as in Direct3D 10
    vk::Format::eR16Sfloat,
    vk::Format::eR16G16Sfloat,
    vk::Format::eR16G16B16A16Sfloat,
    vk::Format::eR32Sfloat,
    vk::Format::eR32G32Sfloat,
    vk::Format::eR32G32B32A32Sfloat,
    vk::Format::eD16Unorm,
    vk::Format::eD24UnormS8Uint,
    vk::Format::eD32Sfloat,
    vk::Format::eD32SfloatS8Uint,
};
static_assert(kFormats.size() == static_cast<std::size_t>(Format::D32FS8) + 1);

/// Packed integers of type T, of which the low `bits` count, as depths 0 to 1.
template <class T>
void unpackUnorm(std::span<const std::byte> texels, std::uint32_t bits, std::span<float> out) {
    const std::uint32_t mask = (1u << bits) - 1u;
    for (std::size_t i = 0; i < out.size(); ++i) {
        T texel{};
        std::memcpy(&texel, texels.data() + i * sizeof(T), sizeof(T));
        out[i] = static_cast<float>(static_cast<double>(texel & mask) / mask); // float cannot hold every quotient's numerator exactly
    }
}

} // namespace

namespace detail {

vk::Format vulkanFormat(Format format) {
    return kFormats[static_cast<std::size_t>(format)];
}

vk::ImageAspectFlags aspects(Format format) {
    if (!isDepth(format)) return vk::ImageAspectFlagBits::eColor;
    vk::ImageAspectFlags flags = vk::ImageAspectFlagBits::eDepth;
    if (hasStencil(format)) flags |= vk::ImageAspectFlagBits::eStencil;
    return flags;
}

std::uint32_t copiedBytesPerPixel(Format format) {
    return format == Format::D32FS8 ? 4 : bytesPerPixel(format);
}

std::vector<std::byte> depthAsFloats(Format format, std::span<const std::byte> texels) {
    if (format == Format::D32F || format == Format::D32FS8) return {texels.begin(), texels.end()};
    std::vector<float> depths(texels.size() / copiedBytesPerPixel(format));
    if (format == Format::D16)
        unpackUnorm<std::uint16_t>(texels, 16, depths);
    else
        unpackUnorm<std::uint32_t>(texels, 24, depths); // the upper 8 bits are undefined
    const auto bytes = std::as_bytes(std::span(depths));
    return {bytes.begin(), bytes.end()};
}

std::string listedSamples(std::uint32_t flags) {
    std::string list;
    for (std::uint32_t samples = 1; samples <= 64; samples *= 2)
        if ((flags & samples) != 0) list += (list.empty() ? "" : ", ") + std::to_string(samples);
    return list;
}

} // namespace detail

} // namespace tegument::gpu
