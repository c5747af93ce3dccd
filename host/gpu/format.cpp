#include "host/gpu/format.h"

#include <cstring>

namespace tegument::gpu {

namespace {

struct FormatRow {
    std::string_view name;
    vk::Format vulkan;
    std::uint32_t bytes;
    bool depth;
    bool stencil;
};

/// In the order of the enumeration.
constexpr std::array kFormats = {
    FormatRow{"R8", vk::Format::eR8Unorm, 1, false, false},
    FormatRow{"RG8", vk::Format::eR8G8Unorm, 2, false, false},
    FormatRow{"RGBA8", vk::Format::eR8G8B8A8Unorm, 4, false, false},
    FormatRow{"BGRA8", vk::Format::eB8G8R8A8Unorm, 4, false, false},
    FormatRow{"RGBA8Srgb", vk::Format::eR8G8B8A8Srgb, 4, false, false},
    FormatRow{"RGBA16", vk::Format::eR16G16B16A16Unorm, 8, false, false},
    FormatRow{"RGB10A2", vk::Format::eA2B10G10R10UnormPack32, 4, false, false}, // red in the low bits, as in Direct3D 10
    FormatRow{"R16F", vk::Format::eR16Sfloat, 2, false, false},
    FormatRow{"RG16F", vk::Format::eR16G16Sfloat, 4, false, false},
    FormatRow{"RGBA16F", vk::Format::eR16G16B16A16Sfloat, 8, false, false},
    FormatRow{"R32F", vk::Format::eR32Sfloat, 4, false, false},
    FormatRow{"RG32F", vk::Format::eR32G32Sfloat, 8, false, false},
    FormatRow{"RGBA32F", vk::Format::eR32G32B32A32Sfloat, 16, false, false},
    FormatRow{"D16", vk::Format::eD16Unorm, 2, true, false},
    FormatRow{"D24S8", vk::Format::eD24UnormS8Uint, 4, true, true},
    FormatRow{"D32F", vk::Format::eD32Sfloat, 4, true, false},
    FormatRow{"D32FS8", vk::Format::eD32SfloatS8Uint, 8, true, true},
};
static_assert(kFormats.size() == static_cast<std::size_t>(Format::D32FS8) + 1);

constexpr const FormatRow& row(Format format) {
    return kFormats[static_cast<std::size_t>(format)];
}

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

bool isDepth(Format format) {
    return row(format).depth;
}
bool hasStencil(Format format) {
    return row(format).stencil;
}
std::uint32_t bytesPerPixel(Format format) {
    return row(format).bytes;
}
std::string_view name(Format format) {
    return row(format).name;
}

namespace detail {

vk::Format vulkanFormat(Format format) {
    return row(format).vulkan;
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
