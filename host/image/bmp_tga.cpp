// Windows's bitmaps and Truevision's Targa files: rows of numbers whose bits are blue, green and red, or that name a colour of a table.
// BMP: Microsoft, Bitmap Storage (versions 2 to 5, without runs). TGA: Truevision TGA File Format Specification 2.0 (1991).

#include "host/image/codecs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace tegument::codec {

namespace {

using Color = std::array<float, 4>;
using Masks = std::array<std::uint32_t, 4>; // of red, green, blue and alpha in a pixel's number

constexpr Masks kFiveBits = {0x7c00, 0x3e0, 0x1f, 0};
constexpr Masks kBytes = {0xff0000, 0xff00, 0xff, 0};
constexpr Masks kGrey = {0xff, 0xff, 0xff, 0};

/// A number of `count` bytes, the last ones first; what lies behind the end is 0.
std::uint32_t number(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = count; i-- > 0;)
        value = value << 8U | (at + i < bytes.size() ? std::to_integer<std::uint32_t>(bytes[at + i]) : 0);
    return value;
}

Color colorOf(std::uint32_t pixel, const Masks& masks) {
    Color color = {0, 0, 0, 1};
    for (std::size_t c = 0; c < 4; ++c)
        if (masks[c] != 0) {
            const int shift = std::countr_zero(masks[c]);
            color[c] = static_cast<float>((pixel & masks[c]) >> shift) / static_cast<float>(masks[c] >> shift);
        }
    return color;
}

struct Layout {
    std::uint32_t width = 0, height = 0, bits = 0; // bits of a pixel
    std::size_t rowBytes = 0;
    bool fromTop = false, fromRight = false;
    Masks masks{};
    std::vector<Color> table{}; // of the colours that pixels name
};

std::vector<Color> tableOf(std::span<const std::byte> bytes, std::size_t at, std::size_t count, std::size_t bytesEach, const Masks& masks) {
    std::vector<Color> table;
    for (std::size_t i = 0; i < count; ++i)
        table.push_back(colorOf(number(bytes, at + i * bytesEach, bytesEach), masks));
    return table;
}

/// `first`: the byte of the file where the rows begin.
Result<Image> unpacked(const Encoded& in, const Layout& from, std::span<const std::byte> rows, std::size_t first) {
    if (rows.size() / from.height < from.rowBytes) return truncated(in, in.bytes.size(), "rows are missing");
    const bool alpha = from.masks[3] != 0;
    Image image{
        .width = static_cast<int>(from.width), .height = static_cast<int>(from.height), .channels = alpha ? 4 : 3, .bitsPerChannel = 8};
    image.pixels.reserve(std::size_t{from.width} * from.height * static_cast<std::size_t>(image.channels));
    for (std::uint32_t y = 0; y < from.height; ++y)
        for (std::uint32_t x = 0; x < from.width; ++x) {
            const std::size_t row = (from.fromTop ? y : from.height - 1 - y) * from.rowBytes;
            const std::size_t bit = std::size_t{from.fromRight ? from.width - 1 - x : x} * from.bits;
            std::uint32_t pixel = number(rows, row + bit / 8, (from.bits + 7) / 8);
            if (from.bits < 8)
                pixel = (pixel >> (8 - from.bits - bit % 8)) & ((1U << from.bits) - 1); // the first pixel in the highest bits
            if (!from.table.empty() && pixel >= from.table.size())
                return damaged(in, first + row + bit / 8, "a pixel names a colour that the table does not have");
            const Color color = from.table.empty() ? colorOf(pixel, from.masks) : from.table[pixel];
            image.pixels.insert(image.pixels.end(), color.begin(), color.begin() + image.channels);
        }
    return image;
}

/// Runs: a byte below 128 and so many pixels and one more; or 128 and more, and one pixel for all of them.
Result<std::vector<std::byte>> withoutRuns(const Encoded& in, std::size_t at, std::size_t pixels, std::size_t each) {
    std::vector<std::byte> rows;
    while (rows.size() < pixels * each) {
        if (at >= in.bytes.size()) return truncated(in, in.bytes.size(), "rows are missing");
        const auto head = std::to_integer<std::size_t>(in.bytes[at++]);
        const bool run = head >= 128;
        const std::size_t count = head % 128 + 1;
        const std::size_t stored = (run ? 1 : count) * each;
        if (stored > in.bytes.size() - at) return truncated(in, in.bytes.size(), "rows are missing");
        for (std::size_t i = 0; i < (run ? count : 1); ++i)
            rows.insert(rows.end(), in.bytes.begin() + static_cast<std::ptrdiff_t>(at),
                        in.bytes.begin() + static_cast<std::ptrdiff_t>(at + stored));
        at += stored;
    }
    return rows;
}

} // namespace

Result<Image> decodeBmp(const Encoded& in) {
    const auto at = [&](std::size_t byte, std::size_t count) { return number(in.bytes, byte, count); };
    if (in.bytes.size() < 26) return truncated(in, in.bytes.size(), "no whole header");
    const std::uint32_t header = at(14, 4);
    const bool old = header == 12;
    if (!old && header < 40) return damaged(in, 14, "a header of another length");
    if (in.bytes.size() - 14 < header) return truncated(in, in.bytes.size(), "no whole header");
    const auto height = static_cast<std::int32_t>(old ? at(20, 2) : at(22, 4));
    const std::uint32_t packing = old ? 0 : at(30, 4);
    Layout from{.width = old ? at(18, 2) : at(18, 4),
                .height = height < 0 ? 0U - static_cast<std::uint32_t>(height) : at(old ? 20 : 22, old ? 2 : 4)};
    from.bits = at(old ? 24 : 28, 2);
    from.fromTop = height < 0;
    if (const auto wrong = sizeError(in, from.width, from.height, 18)) return *wrong;
    constexpr std::array<std::uint32_t, 6> kBits = {1, 4, 8, 16, 24, 32};
    if (std::ranges::find(kBits, from.bits) == kBits.end()) return damaged(in, old ? 24 : 28, "pixels of another number of bits");
    const bool ownMasks = packing == 3 || packing == 6;
    if (packing != 0 && !ownMasks)
        return unsupported(in, "a BMP file in runs, or with another file inside,", "save it without compression, or as PNG", 30);
    from.masks = from.bits == 16 ? kFiveBits : kBytes;
    if (ownMasks) from.masks = {at(54, 4), at(58, 4), at(62, 4), header >= 56 || packing == 6 ? at(66, 4) : 0};
    from.rowBytes = (std::size_t{from.width} * from.bits + 31) / 32 * 4;
    if (from.bits <= 8) {
        const std::size_t named = old ? 0 : at(46, 4), most = std::size_t{1} << from.bits;
        from.masks = kBytes;
        from.table = tableOf(in.bytes, 14 + header, named > 0 ? std::min(named, most) : most, old ? 3 : 4, kBytes);
    }
    const std::size_t first = std::min<std::size_t>(at(10, 4), in.bytes.size());
    return unpacked(in, from, in.bytes.subspan(first), first);
}

/// The format has no mark of its own: a header of which each part is possible.
bool isTga(std::span<const std::byte> bytes) {
    const auto at = [&](std::size_t byte, std::size_t count) { return number(bytes, byte, count); };
    if (bytes.size() < 18 || at(12, 2) == 0 || at(14, 2) == 0 || at(17, 1) >= 64) return false;
    const std::uint32_t table = at(1, 1), kind = at(2, 1), bits = at(16, 1);
    if ((kind & ~8U) == 1) return table == 1 && bits == 8 && at(5, 2) > 0 && (at(7, 1) == 24 || at(7, 1) == 32);
    if ((kind & ~8U) == 2) return table == 0 && (bits == 15 || bits == 16 || bits == 24 || bits == 32);
    return (kind & ~8U) == 3 && table == 0 && bits == 8;
}

Result<Image> decodeTga(const Encoded& in) {
    const auto at = [&](std::size_t byte, std::size_t count) { return number(in.bytes, byte, count); };
    Layout from{.width = at(12, 2), .height = at(14, 2), .bits = at(16, 1)};
    if (const auto wrong = sizeError(in, from.width, from.height, 12)) return *wrong;
    const std::uint32_t kind = at(2, 1);
    from.fromTop = (at(17, 1) & 32U) != 0;
    from.fromRight = (at(17, 1) & 16U) != 0;
    from.masks = from.bits == 8 ? kGrey : from.bits <= 16 ? kFiveBits : kBytes;
    if (from.bits == 32 && at(17, 1) % 16 == 8) from.masks[3] = 0xff000000;
    const std::size_t each = (from.bits + 7) / 8;
    from.rowBytes = from.width * each;
    std::size_t first = 18 + at(0, 1);
    if ((kind & ~8U) == 1) {
        const std::size_t bytesEach = at(7, 1) / 8;
        from.masks = kBytes;
        from.table.assign(at(3, 2), {}); // colours before the first of the file's
        std::ranges::copy(tableOf(in.bytes, first, at(5, 2), bytesEach, kBytes), std::back_inserter(from.table));
        first += at(5, 2) * bytesEach;
    }
    if (first >= in.bytes.size()) return truncated(in, in.bytes.size(), "rows are missing");
    if (kind < 8) return unpacked(in, from, in.bytes.subspan(first), first);
    const auto rows = withoutRuns(in, first, std::size_t{from.width} * from.height, each);
    if (!rows) return rows.error();
    return unpacked(in, from, *rows, first);
}

} // namespace tegument::codec
