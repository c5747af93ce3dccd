// DDS -> floats. Every number of the header is held against the file's size before memory is taken.

#include "host/image/codecs.h"
#include "host/image/dds_layout.h"
#include "host/support/file.h"

#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <new>

namespace tegument {

namespace {

using codec::Encoded;

/// What the header says, checked.
struct Layout {
    const dds::FormatRow* format = nullptr;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    int faces = 1;
    int mips = 1;
    std::size_t firstByte = dds::kPixels;
};

std::uint32_t word(const Encoded& in, std::size_t offset) {
    std::uint32_t value = 0;
    for (unsigned i = 0; i < 4; ++i)
        value |= std::to_integer<std::uint32_t>(in.bytes[offset + i]) << (8 * i);
    return value;
}

Error unknownFormat(const Encoded& in, std::size_t offset, const std::string& what) {
    return codec::unsupported(in, what, "save it as R8G8B8A8_UNORM, R16G16B16A16_FLOAT or R32G32B32A32_FLOAT", offset);
}

/// DXGI formats and D3DFORMATs that a FourCC holds.
Result<const dds::FormatRow*> formatByNumber(const Encoded& in, std::size_t offset, std::uint32_t dds::FormatRow::*number) {
    const std::uint32_t wanted = word(in, offset);
    for (const dds::FormatRow& row : dds::kFormats)
        if (row.*number == wanted && wanted != 0) return &row;
    const bool dxgi = number == &dds::FormatRow::dxgi;
    return unknownFormat(in, offset, fmt::format("a DDS file of {} {} (0x{:08x})", dxgi ? "DXGI format" : "FourCC", wanted, wanted));
}

/// Pixels described by masks: A8R8G8B8 and A8B8G8R8.
Result<const dds::FormatRow*> formatByMasks(const Encoded& in) {
    std::array<std::uint32_t, 4> masks{};
    for (std::size_t i = 0; i < 4; ++i)
        masks[i] = word(in, dds::kMasks + 4 * i);
    const bool plain = (word(in, dds::kPixelFormatFlags) & dds::kRgbFlag) != 0 && word(in, dds::kBitCount) == 32;
    for (const dds::FormatRow& row : dds::kFormats)
        if (plain && row.format == DdsFormat::Rgba8 && masks == (row.blueFirst ? dds::kBlueFirstMasks : dds::kRedFirstMasks)) return &row;
    return unknownFormat(in, dds::kPixelFormatFlags,
                         fmt::format("a DDS file of {} bits with masks {:08x} {:08x} {:08x} {:08x}", word(in, dds::kBitCount), masks[0],
                                     masks[1], masks[2], masks[3]));
}

Result<void> readDx10(const Encoded& in, Layout& layout) {
    if (in.bytes.size() < dds::kPixelsDx10) return codec::truncated(in, in.bytes.size(), "the DX10 header is cut off");
    const auto format = formatByNumber(in, dds::kDxgiFormat, &dds::FormatRow::dxgi);
    if (!format) return format.error();
    if (word(in, dds::kDimension) != dds::kDimension2D)
        return codec::unsupported(in, "a one- or three-dimensional DDS texture", "effects take Texture2D and TextureCube", dds::kDimension);
    if (word(in, dds::kArraySize) != 1)
        return codec::unsupported(in, fmt::format("a DDS array of {} textures", word(in, dds::kArraySize)), "save one texture a file",
                                  dds::kArraySize);
    layout.format = *format;
    layout.faces = (word(in, dds::kMisc) & dds::kMiscCube) != 0 ? 6 : 1;
    layout.firstByte = dds::kPixelsDx10;
    return {};
}

Result<void> readDirect3D9(const Encoded& in, bool named, Layout& layout) {
    const auto format = named ? formatByNumber(in, dds::kFourCC, &dds::FormatRow::d3d9) : formatByMasks(in);
    if (!format) return format.error();
    layout.format = *format;
    const std::uint32_t caps2 = word(in, dds::kCaps2);
    if ((caps2 & dds::kCaps2Cube) == 0) return {};
    if ((caps2 & dds::kCaps2AllFaces) != dds::kCaps2AllFaces)
        return codec::unsupported(in, "a DDS cube map without all of its six faces", "save all six", dds::kCaps2);
    layout.faces = 6;
    return {};
}

Result<void> readSize(const Encoded& in, Layout& layout) {
    layout.width = word(in, dds::kWidth);
    layout.height = word(in, dds::kHeight);
    if (const auto wrong = codec::sizeError(in, layout.width, layout.height, dds::kHeight)) return *wrong;
    const std::uint32_t mips = (word(in, dds::kFlags) & dds::kMipFlag) != 0 ? std::max(word(in, dds::kMipCount), 1U) : 1;
    const auto chain = static_cast<std::uint32_t>(std::bit_width(std::max(layout.width, layout.height)));
    if (mips > chain)
        return codec::damaged(in, dds::kMipCount, fmt::format("{} mip levels; {} x {} has {}", mips, layout.width, layout.height, chain));
    layout.mips = static_cast<int>(mips);
    return {};
}

Result<Layout> readHeader(const Encoded& in) {
    if (in.bytes.size() < dds::kPixels) return codec::truncated(in, in.bytes.size(), "the header is cut off");
    for (const auto& [offset, size] : {std::pair(dds::kHeaderSize, 124U), std::pair(dds::kPixelFormatSize, 32U)})
        if (word(in, offset) != size)
            return codec::damaged(in, offset, fmt::format("a header size of {}, where {} must stand", word(in, offset), size));
    if ((word(in, dds::kCaps2) & dds::kCaps2Volume) != 0 || ((word(in, dds::kFlags) & dds::kVolumeFlag) != 0 && word(in, dds::kDepth) > 1))
        return codec::unsupported(in, "a volume texture", "effects take Texture2D and TextureCube", dds::kDepth);
    Layout layout;
    if (const auto size = readSize(in, layout); !size) return size.error();
    const bool named = (word(in, dds::kPixelFormatFlags) & dds::kFourCCFlag) != 0;
    const bool dx10 = named && word(in, dds::kFourCC) == dds::kDx10Word;
    if (const auto format = dx10 ? readDx10(in, layout) : readDirect3D9(in, named, layout); !format) return format.error();
    if (layout.faces == 6 && layout.width != layout.height)
        return codec::damaged(in, dds::kHeight, fmt::format("a cube map of {} x {} pixels", layout.width, layout.height));
    return layout;
}

std::uint32_t reduced(std::uint32_t size, int mip) {
    return std::max(size >> static_cast<unsigned>(mip), 1U);
}

std::size_t bytesOf(const Layout& layout, int mip) {
    return std::size_t{reduced(layout.width, mip)} * reduced(layout.height, mip) *
           static_cast<std::size_t>(layout.format->channels * layout.format->bytesPerChannel);
}

Result<void> checkLength(const Encoded& in, const Layout& layout) {
    std::size_t needed = layout.firstByte;
    for (int face = 0; face < layout.faces; ++face)
        for (int mip = 0; mip < layout.mips; ++mip)
            needed += bytesOf(layout, mip);
    if (in.bytes.size() < needed)
        return codec::truncated(in, in.bytes.size(), fmt::format("{} bytes are needed, {} are there", needed, in.bytes.size()));
    if (in.bytes.size() > needed)
        return codec::damaged(in, needed, fmt::format("{} bytes follow the last texel", in.bytes.size() - needed));
    return {};
}

float channel(const std::byte* at, int bytes) {
    if (bytes == 1) return static_cast<float>(std::to_integer<int>(*at)) / 255.0F;
    if (bytes == 2) {
        half value;
        value.setBits(static_cast<unsigned short>(std::to_integer<unsigned>(at[0]) | std::to_integer<unsigned>(at[1]) << 8));
        return value;
    }
    float value = 0;
    std::memcpy(&value, at, sizeof value); // the host is little-endian too: dds_write.cpp asserts it
    return value;
}

Image readImage(const Layout& layout, int mip, std::span<const std::byte> bytes) {
    const dds::FormatRow& format = *layout.format;
    Image image{.width = static_cast<int>(reduced(layout.width, mip)),
                .height = static_cast<int>(reduced(layout.height, mip)),
                .channels = format.channels,
                .bitsPerChannel = format.bytesPerChannel == 1 ? 8 : 32, // halves are floats, not 16-bit integers
                .metadata = {}};
    const auto step = static_cast<std::size_t>(format.bytesPerChannel);
    image.pixels.resize(bytes.size() / step);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = channel(bytes.data() + i * step, format.bytesPerChannel);
    if (format.blueFirst)
        for (std::size_t i = 0; i < image.pixels.size(); i += 4)
            std::swap(image.pixels[i], image.pixels[i + 2]);
    return image;
}

Result<DdsTexture> decode(const Encoded& in) {
    const auto layout = readHeader(in);
    if (!layout) return layout.error();
    if (const auto checked = checkLength(in, *layout); !checked) return checked.error();
    DdsTexture texture{.format = layout->format->format, .faces = layout->faces, .mips = layout->mips};
    std::size_t offset = layout->firstByte;
    for (int face = 0; face < layout->faces; ++face)
        for (int mip = 0; mip < layout->mips; ++mip) {
            const std::size_t size = bytesOf(*layout, mip);
            texture.images.push_back(readImage(*layout, mip, in.bytes.subspan(offset, size)));
            offset += size;
        }
    return texture;
}

} // namespace

bool isDds(std::span<const std::byte> bytes) {
    return bytes.size() >= 4 && word({.bytes = bytes, .name = {}}, dds::kMagic) == dds::kMagicWord;
}

Result<DdsTexture> decodeDds(std::span<const std::byte> bytes, const std::string& nameForMessages) {
    const Encoded in{.bytes = bytes, .name = nameForMessages};
    if (!isDds(bytes)) return codec::damaged(in, 0, "it does not start with 'DDS '");
    try {
        return decode(in);
    } catch (const std::bad_alloc&) {
        return codec::outOfMemory(nameForMessages);
    }
}

Result<DdsTexture> loadDds(const std::filesystem::path& path) {
    const Result<std::string> bytes = readFile(path);
    if (!bytes) return bytes.error();
    return decodeDds(std::as_bytes(std::span(*bytes)), path.string());
}

bool isWholeDds(const std::filesystem::path& path) {
    const Result<std::string> read = readFile(path);
    if (!read || !isDds(std::as_bytes(std::span(*read)))) return false;
    const std::string name = path.string();
    const Encoded in{.bytes = std::as_bytes(std::span(*read)), .name = name};
    const auto layout = readHeader(in);
    return layout && static_cast<bool>(checkLength(in, *layout));
}

} // namespace tegument
