#include "host/run/pixels.h"

#include "host/run/target_desc.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>

namespace tegument::run {

namespace {

enum class Storage { Unorm8, Unorm16, Half, Float, Packed10 };

Storage storageOf(PixelFormat format) {
    switch (format) {
    case PixelFormat::R8:
    case PixelFormat::RG8:
    case PixelFormat::RGBA8:
    case PixelFormat::BGRA8:
    case PixelFormat::RGBA8Srgb: return Storage::Unorm8;
    case PixelFormat::RGBA16: return Storage::Unorm16;
    case PixelFormat::RGB10A2: return Storage::Packed10;
    case PixelFormat::R16F:
    case PixelFormat::RG16F:
    case PixelFormat::RGBA16F: return Storage::Half;
    default: return Storage::Float;
    }
}

template <class T>
T load(std::span<const std::byte> texels, std::size_t index) {
    T value;
    std::memcpy(&value, texels.data() + index * sizeof value, sizeof value);
    return value;
}

template <class T>
T unorm(float value) {
    constexpr auto kMax = static_cast<float>(static_cast<T>(~T{0}));
    const float share = value > 0.0F ? std::min(value, 1.0F) : 0.0F; // NaN: 0
    return static_cast<T>(static_cast<double>(share * kMax) + 0.5);  // rounds as lround does, in less time
}

float loadChannel(std::span<const std::byte> texels, std::size_t index, Storage storage) {
    switch (storage) {
    case Storage::Unorm8: return static_cast<float>(load<std::uint8_t>(texels, index)) / 255.0F;
    case Storage::Unorm16: return static_cast<float>(load<std::uint16_t>(texels, index)) / 65535.0F;
    case Storage::Half: return glm::unpackHalf1x16(load<std::uint16_t>(texels, index));
    default: return load<float>(texels, index);
    }
}

/// Ten bits each, red lowest, then two bits of alpha.
void unpack10(std::uint32_t texel, float* rgba) {
    for (int channel = 0; channel < 3; ++channel)
        rgba[channel] = static_cast<float>(texel >> (10 * channel) & 1023U) / 1023.0F;
    rgba[3] = static_cast<float>(texel >> 30) / 3.0F;
}

/// One pixel spread to four channels.
std::array<float, 4> pixel(const Image& image, std::size_t index, bool decode) {
    const auto channels = static_cast<std::size_t>(image.channels);
    const float* source = image.pixels.data() + index * channels;
    const bool grey = channels < 3;
    std::array<float, 4> rgba{source[0], grey ? source[0] : source[1], grey ? source[0] : source[2], 1.0F};
    if (channels == 4) rgba[3] = source[3];
    if (channels == 2) rgba[3] = source[1];
    if (decode)
        for (std::size_t i = 0; i < 3; ++i)
            rgba[i] = srgbToLinear(rgba[i]);
    return rgba;
}

/// Every pixel's channels, converted, one behind the other.
template <class Convert>
std::vector<std::byte> packed(const Image& image, int channels, bool decode, Convert convert) {
    using Value = decltype(convert(0.0F));
    const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    std::vector<std::byte> out(count * static_cast<std::size_t>(channels) * sizeof(Value));
    std::byte* to = out.data();
    for (std::size_t i = 0; i < count; ++i) {
        std::array<float, 4> rgba = pixel(image, i, decode);
        if (channels == 2) rgba[1] = image.pixels[i * static_cast<std::size_t>(image.channels) + 1];
        for (int channel = 0; channel < channels; ++channel, to += sizeof(Value)) {
            const Value value = convert(rgba[static_cast<std::size_t>(channel)]);
            std::memcpy(to, &value, sizeof value);
        }
    }
    return out;
}

} // namespace

PixelFormat formatFor(const Image& image, bool srgb) {
    if (image.bitsPerChannel == 8) return srgb ? PixelFormat::RGBA8Srgb : PixelFormat::RGBA8;
    if (image.bitsPerChannel == 16 && !srgb) return PixelFormat::RGBA16;
    return PixelFormat::RGBA32F;
}

std::vector<std::byte> texels(const Image& image, PixelFormat format, bool decode) {
    const int channels = channelCount(format);
    assert(storageOf(format) != Storage::Packed10 && (channels == 4 || channels <= image.channels));
    switch (storageOf(format)) {
    case Storage::Unorm8: return packed(image, channels, decode, unorm<std::uint8_t>);
    case Storage::Unorm16: return packed(image, channels, decode, unorm<std::uint16_t>);
    case Storage::Half: return packed(image, channels, decode, glm::packHalf1x16);
    default: return packed(image, channels, decode, [](float value) { return value; });
    }
}

Image imageFrom(std::span<const std::byte> texels, int width, int height, PixelFormat format) {
    Image image{.width = width, .height = height, .channels = channelCount(format)};
    const Storage storage = storageOf(format);
    image.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(image.channels));
    if (storage == Storage::Packed10) {
        for (std::size_t i = 0; i * 4 < image.pixels.size(); ++i)
            unpack10(load<std::uint32_t>(texels, i), image.pixels.data() + i * 4);
        return image;
    }
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = loadChannel(texels, i, storage);
    if (format == PixelFormat::BGRA8)
        for (std::size_t i = 0; i < image.pixels.size(); i += 4)
            std::swap(image.pixels[i], image.pixels[i + 2]);
    return image;
}

Result<Image> readBack(gpu::Device& device, gpu::Texture& texture, std::uint32_t mip, std::uint32_t face) {
    const auto bytes = device.readback(texture, mip, face);
    if (!bytes) return bytes.error();
    const gpu::TextureDesc& desc = texture.desc();
    return imageFrom(*bytes, static_cast<int>(std::max(desc.width >> mip, 1U)), static_cast<int>(std::max(desc.height >> mip, 1U)),
                     desc.format);
}

Result<Image> readBackRows(gpu::Device& device, gpu::Texture& texture, int rows) {
    const auto bytes = device.readback(texture);
    if (!bytes) return bytes.error();
    const gpu::TextureDesc& desc = texture.desc();
    const int height = static_cast<int>(desc.height);
    const int step = std::max(1, height / std::max(1, rows));
    const std::size_t row = bytes->size() / desc.height;
    std::vector<std::byte> some;
    int count = 0;
    for (int y = step / 2; y < height; y += step, ++count) {
        const auto begin = bytes->begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * row);
        some.insert(some.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
    }
    return imageFrom(some, static_cast<int>(desc.width), count, desc.format);
}

Result<Image> readBackPart(gpu::Texture& texture, const gpu::TexelRect& part, std::uint32_t mip) {
    const auto bytes = gpu::readbackPart(texture, part, mip);
    if (!bytes) return bytes.error();
    return imageFrom(*bytes, static_cast<int>(part.width), static_cast<int>(part.height), texture.desc().format);
}

} // namespace tegument::run
