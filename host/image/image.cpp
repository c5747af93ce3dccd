// Images by content: which decoder, and the conversion to eight bits.

#include "host/image/image.h"

#include "host/image/codecs.h"
#include "host/image/dds.h"
#include "host/support/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

namespace tegument {

Image plainImage(int width, int height, int channels, float value) {
    Image image{.width = width, .height = height, .channels = channels};
    image.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels), value);
    return image;
}

namespace codec {

Error truncated(const Encoded& in, std::size_t byte, const std::string& detail) {
    return inputError(5201, {.file = in.name, .byte = byte}, "the image ends early: " + detail, "fetch or export the file again");
}

Error damaged(const Encoded& in, std::size_t byte, const std::string& detail) {
    return inputError(5202, {.file = in.name, .byte = byte}, "the image is damaged: " + detail, "fetch or export the file again");
}

std::optional<Error> sizeError(const Encoded& in, std::uint64_t width, std::uint64_t height, std::optional<std::size_t> byte) {
    if (width > 0 && height > 0 && width <= kMaxSize && height <= kMaxSize) return std::nullopt;
    return inputError(5203, {.file = in.name, .byte = byte}, fmt::format("the image is {} x {} pixels", width, height),
                      fmt::format("from 1 to {} in each direction can be read", kMaxSize));
}

Error unsupported(const Encoded& in, const std::string& what, const std::string& hint, std::optional<std::size_t> byte) {
    return inputError(5204, {.file = in.name, .byte = byte}, what + " cannot be read", hint);
}

Error outOfMemory(const std::string& name) {
    return machineError(5205, fmt::format("{}: not enough memory for the image", name));
}

} // namespace codec

namespace {

bool startsWith(std::span<const std::byte> bytes, std::initializer_list<unsigned char> magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(), [](unsigned char a, std::byte b) { return std::byte{a} == b; });
}

Error unknownFormat(const codec::Encoded& in) {
    std::string start;
    for (std::size_t i = 0; i < std::min<std::size_t>(8, in.bytes.size()); ++i)
        start += fmt::format("{}{:02x}", i ? " " : "", std::to_integer<unsigned>(in.bytes[i]));
    const std::string text =
        in.bytes.empty() ? "the file is empty" : fmt::format("not a PNG, JPEG, EXR, HDR, DDS, BMP or TGA image: it starts with {}", start);
    return inputError(5200, {.file = in.name, .byte = 0}, text, "convert it to PNG, JPEG, EXR, HDR or DDS");
}

/// The largest level of a two-dimensional DDS texture.
Result<Image> flatDds(const codec::Encoded& in) {
    Result<DdsTexture> texture = decodeDds(in.bytes, in.name);
    if (!texture) return texture.error();
    if (texture->isCube()) return codec::unsupported(in, "a cube map as a picture", "give it to a TextureCube");
    return std::move(texture->images.front());
}

Result<Image> decodeByContent(const codec::Encoded& in) {
    if (startsWith(in.bytes, {0x89, 'P', 'N', 'G'})) return codec::decodePng(in);
    if (startsWith(in.bytes, {0xff, 0xd8})) return codec::decodeJpeg(in);
    if (startsWith(in.bytes, {0x76, 0x2f, 0x31, 0x01})) return codec::decodeExr(in);
    if (startsWith(in.bytes, {'#', '?', 'R', 'A'}) || startsWith(in.bytes, {'#', '?', 'R', 'G'})) return codec::decodeHdr(in);
    if (isDds(in.bytes)) return flatDds(in);
    if (startsWith(in.bytes, {'B', 'M'})) return codec::decodeBmp(in);
    if (codec::isTga(in.bytes)) return codec::decodeTga(in);
    return unknownFormat(in);
}

[[maybe_unused]] bool consistent(const Image& image) {
    return image.width > 0 && image.height > 0 && image.channels >= 1 && image.channels <= 4 &&
           image.pixels.size() ==
               static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * static_cast<std::size_t>(image.channels);
}

unsigned char toByte(float value) {
    if (!(value > 0)) return 0; // NaN too
    return static_cast<unsigned char>(std::lround(std::min(value, 1.0f) * 255));
}

unsigned char encodeSample(float value, bool isAlpha, PngEncoding encoding) {
    if (isAlpha || encoding == PngEncoding::Raw) return toByte(value);
    return toByte(linearToSrgb(encoding == PngEncoding::Display ? toneMap(value) : std::max(value, 0.0f)));
}

codec::Samples8 toSamples(const Image& image, PngEncoding encoding) {
    const bool hasAlpha = image.channels == 2 || image.channels == 4;
    const bool keepAlpha = hasAlpha && encoding != PngEncoding::Display;
    codec::Samples8 samples{.width = static_cast<std::uint32_t>(image.width),
                            .height = static_cast<std::uint32_t>(image.height),
                            .channels = keepAlpha || !hasAlpha ? image.channels : image.channels - 1,
                            .srgb = encoding != PngEncoding::Raw};
    const auto stride = static_cast<std::size_t>(image.channels);
    samples.bytes.reserve(image.pixels.size());
    for (std::size_t pixel = 0; pixel < image.pixels.size(); pixel += stride)
        for (std::size_t c = 0; c < static_cast<std::size_t>(samples.channels); ++c)
            samples.bytes.push_back(encodeSample(image.pixels[pixel + c], hasAlpha && c + 1 == stride, encoding));
    return samples;
}

} // namespace

Result<Image> decodeImage(std::span<const std::byte> bytes, const std::string& nameForMessages) {
    try {
        return decodeByContent({.bytes = bytes, .name = nameForMessages});
    } catch (const std::bad_alloc&) {
        return codec::outOfMemory(nameForMessages);
    }
}

Result<Image> loadImage(const std::filesystem::path& path) {
    const Result<std::string> bytes = readFile(path);
    if (!bytes) return bytes.error();
    return decodeImage(std::as_bytes(std::span(*bytes)), path.string());
}

Result<void> writeExr(const std::filesystem::path& path, const Image& image, ExrDepth depth) {
    assert(consistent(image));
    const Result<std::string> bytes = codec::encodeExr(image, depth);
    if (!bytes) return bytes.error();
    return writeFile(path, *bytes);
}

Result<void> writePng(const std::filesystem::path& path, const Image& image, PngEncoding encoding) {
    const Result<std::string> bytes = encodePng(image, encoding);
    if (!bytes) return bytes.error();
    return writeFile(path, *bytes);
}

Result<void> writeJpeg(const std::filesystem::path& path, const Image& image) {
    assert(consistent(image));
    codec::Samples8 samples{.width = static_cast<std::uint32_t>(image.width),
                            .height = static_cast<std::uint32_t>(image.height),
                            .channels = image.channels < 3 ? 1 : 3,
                            .srgb = false};
    for (std::size_t pixel = 0; pixel < image.pixels.size(); pixel += static_cast<std::size_t>(image.channels))
        for (std::size_t c = 0; c < static_cast<std::size_t>(samples.channels); ++c)
            samples.bytes.push_back(toByte(image.pixels[pixel + c]));
    const Result<std::string> bytes = codec::encodeJpeg(samples, image.metadata);
    if (!bytes) return bytes.error();
    return writeFile(path, *bytes);
}

Image displayed(const Image& radiance) {
    assert(consistent(radiance));
    const int channels = radiance.channels < 3 ? 1 : 3;
    Image image{
        .width = radiance.width, .height = radiance.height, .channels = channels, .bitsPerChannel = 8, .metadata = radiance.metadata};
    image.pixels.reserve(radiance.pixels.size() / static_cast<std::size_t>(radiance.channels) * static_cast<std::size_t>(channels));
    for (std::size_t pixel = 0; pixel < radiance.pixels.size(); pixel += static_cast<std::size_t>(radiance.channels))
        for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c)
            image.pixels.push_back(linearToSrgb(toneMap(radiance.pixels[pixel + c])));
    return image;
}

Result<std::string> encodePng(const Image& image, PngEncoding encoding) {
    assert(consistent(image));
    try {
        return codec::encodePng(toSamples(image, encoding), image.metadata);
    } catch (const std::bad_alloc&) {
        return codec::outOfMemory("PNG");
    }
}

} // namespace tegument
