// Floats -> DDS.

#include "host/image/dds_layout.h"
#include "host/image/mips.h"
#include "host/support/file.h"

#include <half.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <iterator>

namespace tegument {

namespace {

static_assert(std::endian::native == std::endian::little, "DDS files are little-endian; floats are copied as they are in memory");

class Header {
public:
    explicit Header(std::size_t size) : bytes_(size, '\0') {}
    void put(std::size_t offset, std::uint32_t value) {
        for (unsigned i = 0; i < 4; ++i)
            bytes_[offset + i] = static_cast<char>(value >> (8 * i) & 255U);
    }
    [[nodiscard]] std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

void putPixelFormat(Header& header, const dds::FormatRow& format, DdsHeader kind) {
    header.put(dds::kPixelFormatSize, 32);
    if (kind == DdsHeader::Dx10 || format.d3d9 != 0) {
        header.put(dds::kPixelFormatFlags, dds::kFourCCFlag);
        header.put(dds::kFourCC, kind == DdsHeader::Dx10 ? dds::kDx10Word : format.d3d9);
        return;
    }
    header.put(dds::kPixelFormatFlags, dds::kRgbFlag | dds::kAlphaPixelsFlag);
    header.put(dds::kBitCount, 32);
    for (std::size_t i = 0; i < 4; ++i) // A8R8G8B8: the order that Direct3D 9 hardware has
        header.put(dds::kMasks + 4 * i, dds::kBlueFirstMasks[i]);
}

std::string headerOf(const DdsTexture& texture, DdsHeader kind) {
    const dds::FormatRow& format = dds::row(texture.format);
    const Image& first = texture.images.front();
    Header header(kind == DdsHeader::Dx10 ? dds::kPixelsDx10 : dds::kPixels);
    header.put(dds::kMagic, dds::kMagicWord);
    header.put(dds::kHeaderSize, 124);
    header.put(dds::kFlags, dds::kRequiredFlags | dds::kPitchFlag | (texture.mips > 1 ? dds::kMipFlag : 0));
    header.put(dds::kHeight, static_cast<std::uint32_t>(first.height));
    header.put(dds::kWidth, static_cast<std::uint32_t>(first.width));
    header.put(dds::kPitch, static_cast<std::uint32_t>(first.width * format.channels * format.bytesPerChannel));
    header.put(dds::kWriter, dds::kOurWord);
    header.put(dds::kMipCount, static_cast<std::uint32_t>(texture.mips));
    putPixelFormat(header, format, kind);
    const bool several = texture.mips > 1 || texture.isCube();
    header.put(dds::kCaps, dds::kCapsTexture | (texture.mips > 1 ? dds::kCapsMipMap : 0) | (several ? dds::kCapsComplex : 0));
    header.put(dds::kCaps2, texture.isCube() ? dds::kCaps2Cube | dds::kCaps2AllFaces : 0);
    if (kind == DdsHeader::Direct3D9) return header.take();
    header.put(dds::kDxgiFormat, format.dxgi);
    header.put(dds::kDimension, dds::kDimension2D);
    header.put(dds::kMisc, texture.isCube() ? dds::kMiscCube : 0);
    header.put(dds::kArraySize, 1);
    header.put(dds::kAlphaMode, 0); // unknown: here alpha is data
    return header.take();
}

void append(std::string& bytes, float value, int size) {
    if (size == 1) {
        const float clamped = value > 0 ? std::min(value, 1.0F) : 0; // NaN too
        bytes.push_back(static_cast<char>(std::lround(clamped * 255)));
        return;
    }
    std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    if (size == 2) bits = half(value).bits();
    for (int i = 0; i < size; ++i)
        bytes.push_back(static_cast<char>(bits >> (8 * i) & 255U));
}

/// Red, green, blue, alpha of one pixel.
std::array<float, 4> spread(const Image& image, std::size_t pixel) {
    const auto channels = static_cast<std::size_t>(image.channels);
    const float* from = image.pixels.data() + pixel * channels;
    if (channels >= 3) return {from[0], from[1], from[2], channels == 4 ? from[3] : 1};
    return {from[0], from[0], from[0], channels == 2 ? from[1] : 1};
}

Image withChannels(const Image& image, int channels) {
    if (image.channels == channels) return image;
    Image result{.width = image.width, .height = image.height, .channels = channels};
    const std::size_t count = image.pixels.size() / static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < count; ++i) {
        const std::array<float, 4> rgba = spread(image, i);
        result.pixels.insert(result.pixels.end(), rgba.begin(), rgba.begin() + channels);
    }
    return result;
}

} // namespace

int channelCount(DdsFormat format) {
    return dds::row(format).channels;
}

std::string_view name(DdsFormat format) {
    return dds::row(format).name;
}

DdsTexture makeDds(const Image& image, DdsFormat format, bool mips) {
    DdsTexture texture{.format = format, .faces = 1, .mips = 1, .images = {withChannels(image, channelCount(format))}};
    if (!mips) return texture;
    std::ranges::move(mipLevels(texture.images.front(), format == DdsFormat::Rgba8Srgb ? MeanOf::Light : MeanOf::Values),
                      std::back_inserter(texture.images));
    texture.mips = static_cast<int>(texture.images.size());
    return texture;
}

std::string encodeDds(const DdsTexture& texture, DdsHeader header) {
    assert(texture.images.size() == static_cast<std::size_t>(texture.faces * texture.mips));
    const dds::FormatRow& format = dds::row(texture.format);
    const bool blueFirst = header == DdsHeader::Direct3D9 && format.bytesPerChannel == 1;
    std::string bytes = headerOf(texture, header);
    std::size_t values = 0;
    for (const Image& image : texture.images)
        values += image.pixels.size();
    bytes.reserve(bytes.size() + values * static_cast<std::size_t>(format.bytesPerChannel));
    for (const Image& image : texture.images) {
        assert(image.channels == format.channels);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const std::size_t from = blueFirst && i % 4 != 1 && i % 4 != 3 ? (i % 4 == 0 ? i + 2 : i - 2) : i;
            append(bytes, image.pixels[from], format.bytesPerChannel);
        }
    }
    return bytes;
}

Result<void> writeDds(const std::filesystem::path& path, const DdsTexture& texture, DdsHeader header) {
    return writeFile(path, encodeDds(texture, header));
}

} // namespace tegument
