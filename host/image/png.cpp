// PNG by libpng. libpng leaves an error by longjmp: every function with a setjmp keeps objects with destructors out of its frame (they live
// in the caller's).

#include "host/image/codecs.h"

#include <png.h>

#include <fmt/format.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>

namespace tegument::codec {

namespace {

/// What libpng's callbacks share with us.
struct Reader {
    std::span<const std::byte> bytes;
    std::size_t offset = 0;
    bool ended = false;
    char message[160] = {};
    png_structp png = nullptr;
    png_infop info = nullptr;

    Reader() = default;
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

[[noreturn]] void onReadError(png_structp png, png_const_charp message) {
    auto* reader = static_cast<Reader*>(png_get_error_ptr(png));
    std::strncpy(reader->message, message, sizeof(reader->message) - 1);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void readBytes(png_structp png, png_bytep target, std::size_t count) {
    auto* reader = static_cast<Reader*>(png_get_io_ptr(png));
    if (count > reader->bytes.size() - reader->offset) {
        reader->offset = reader->bytes.size();
        reader->ended = true;
        png_error(png, "the next chunk is cut off");
    }
    std::memcpy(target, reader->bytes.data() + reader->offset, count);
    reader->offset += count;
}

/// Asks libpng for 8 or 16 bit grey, grey + alpha, RGB or RGBA.
void requestPlainSamples(png_structp png, png_infop info) {
    png_set_expand(png); // palette to RGB, 1, 2 and 4 bit to 8, tRNS to alpha
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
}

bool readHeader(Reader& reader) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_set_user_limits(reader.png, 0x7fffffff, 0x7fffffff); // the size is ours to judge
    png_set_chunk_cache_max(reader.png, 256);
    png_set_chunk_malloc_max(reader.png, 8u << 20);
    png_set_read_fn(reader.png, &reader, readBytes);
    png_read_info(reader.png, reader.info);
    requestPlainSamples(reader.png, reader.info);
    return true;
}

bool readRows(Reader& reader, png_bytepp rows) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_read_image(reader.png, rows);
    png_read_end(reader.png, reader.info);
    return true;
}

Error readError(const Encoded& in, const Reader& reader) {
    return reader.ended ? truncated(in, reader.offset, reader.message) : damaged(in, reader.offset, reader.message);
}

/// Deflate cannot expand by more than 1032 (258 bytes from 2 bits), so a small file that claims a large image is cut off; found before
/// memory is taken.
bool claimsMoreThanDeflateCanHold(const Encoded& in, std::size_t rowBytes, std::size_t height) {
    return rowBytes * height > 1032 * in.bytes.size();
}

void copyText(const Reader& reader, Image& image) {
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(reader.png, reader.info, &texts, &count);
    for (int i = 0; i < count; ++i)
        if (texts[i].text) image.metadata[texts[i].key] = texts[i].text;
}

void convert(const std::vector<unsigned char>& bytes, int bits, std::vector<float>& pixels) {
    if (bits == 16) {
        pixels.resize(bytes.size() / 2);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            pixels[i] = static_cast<float>(bytes[2 * i] * 256 + bytes[2 * i + 1]) / 65535.0f;
        return;
    }
    pixels.resize(bytes.size());
    std::ranges::transform(bytes, pixels.begin(), [](unsigned char byte) { return static_cast<float>(byte) / 255.0f; });
}

Result<Image> readPixels(const Encoded& in, Reader& reader) {
    const std::size_t width = png_get_image_width(reader.png, reader.info);
    const std::size_t height = png_get_image_height(reader.png, reader.info);
    if (const auto wrong = sizeError(in, width, height)) return *wrong;
    const std::size_t rowBytes = png_get_rowbytes(reader.png, reader.info);
    if (claimsMoreThanDeflateCanHold(in, rowBytes, height))
        return truncated(in, in.bytes.size(), fmt::format("{} x {} pixels cannot be held by {} bytes", width, height, in.bytes.size()));
    std::vector<unsigned char> bytes(rowBytes * height);
    std::vector<png_bytep> rows(height);
    for (std::size_t y = 0; y < height; ++y)
        rows[y] = bytes.data() + y * rowBytes;
    if (!readRows(reader, rows.data())) return readError(in, reader);

    Image image{.width = static_cast<int>(width),
                .height = static_cast<int>(height),
                .channels = png_get_channels(reader.png, reader.info),
                .bitsPerChannel = png_get_bit_depth(reader.png, reader.info)};
    convert(bytes, image.bitsPerChannel, image.pixels);
    copyText(reader, image);
    return image;
}

struct Writer {
    std::string bytes;
    char message[160] = {};
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::vector<png_text> texts;

    Writer() = default;
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() { png_destroy_write_struct(&png, &info); }
};

[[noreturn]] void onWriteError(png_structp png, png_const_charp message) {
    auto* writer = static_cast<Writer*>(png_get_error_ptr(png));
    std::strncpy(writer->message, message, sizeof(writer->message) - 1);
    png_longjmp(png, 1);
}

void appendBytes(png_structp png, png_bytep bytes, std::size_t count) {
    static_cast<Writer*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(bytes), count);
}

void flush(png_structp) {}

int colorType(int channels) {
    constexpr int kTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
    return kTypes[channels - 1];
}

bool isAscii(const std::string& text) {
    return std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 128; });
}

/// tEXt is Latin-1; anything beyond ASCII goes into iTXt, which is UTF-8.
std::vector<png_text> textChunks(const std::map<std::string, std::string>& metadata) {
    std::vector<png_text> texts;
    for (const auto& [key, value] : metadata) {
        png_text text{};
        text.compression = isAscii(value) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
        text.key = const_cast<char*>(key.c_str()); // libpng's field is not const, but it only reads
        text.text = const_cast<char*>(value.c_str());
        text.text_length = isAscii(value) ? value.size() : 0;
        text.itxt_length = isAscii(value) ? 0 : value.size();
        texts.push_back(text);
    }
    return texts;
}

bool writeAll(Writer& writer, const Samples8& samples) {
    if (setjmp(png_jmpbuf(writer.png))) return false;
    png_set_write_fn(writer.png, &writer, appendBytes, flush);
    png_set_IHDR(writer.png, writer.info, samples.width, samples.height, 8, colorType(samples.channels), PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (samples.srgb) png_set_sRGB_gAMA_and_cHRM(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (!writer.texts.empty()) png_set_text(writer.png, writer.info, writer.texts.data(), static_cast<int>(writer.texts.size()));
    png_write_info(writer.png, writer.info);
    const std::size_t rowBytes = samples.width * static_cast<std::size_t>(samples.channels);
    for (std::size_t y = 0; y < samples.height; ++y)
        png_write_row(writer.png, samples.bytes.data() + y * rowBytes);
    png_write_end(writer.png, writer.info);
    return true;
}

} // namespace

Result<Image> decodePng(const Encoded& in) {
    Reader reader;
    reader.bytes = in.bytes;
    reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, onReadError, onWarning);
    reader.info = reader.png ? png_create_info_struct(reader.png) : nullptr;
    if (!reader.info) return outOfMemory(in.name);
    if (!readHeader(reader)) return readError(in, reader);
    return readPixels(in, reader);
}

Result<std::string> encodePng(const Samples8& samples, const std::map<std::string, std::string>& metadata) {
    Writer writer;
    writer.texts = textChunks(metadata);
    writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer, onWriteError, onWarning);
    writer.info = writer.png ? png_create_info_struct(writer.png) : nullptr;
    if (!writer.info) return outOfMemory("PNG");
    if (!writeAll(writer, samples)) return machineError(5205, fmt::format("PNG cannot be encoded: {}", writer.message));
    return std::move(writer.bytes);
}

} // namespace tegument::codec
