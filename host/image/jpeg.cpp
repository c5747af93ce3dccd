// JPEG by libjpeg-turbo. Errors leave by longjmp: see png.cpp. Truncated data is only a warning to libjpeg, which then invents grey; here
// it is an error.

#include "host/image/codecs.h"

#include <cstddef>
#include <cstdio>

#include <jerror.h>
#include <jpeglib.h>

#include <fmt/format.h>

#include <algorithm>
#include <csetjmp>
#include <cstdlib>

namespace tegument::codec {

namespace {

/// More scans than any encoder writes (libjpeg's own script has 10); each one costs a walk over all coefficients.
constexpr int kMaxScans = 200;

/// `errors` is first, so that libjpeg's pointer to it is a pointer to this.
struct Errors {
    jpeg_error_mgr errors{};
    std::jmp_buf jump{};
    char message[JMSG_LENGTH_MAX] = {};
    bool ended = false;
};

struct Reader {
    jpeg_decompress_struct jpeg{};
    Errors errors;
    jpeg_progress_mgr progress{};
    std::size_t size = 0;
    std::vector<unsigned char> row;

    Reader() = default;
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { jpeg_destroy_decompress(&jpeg); }

    /// Where the decoder stands. At the end libjpeg reads from a buffer of its own (a made-up end marker).
    [[nodiscard]] std::size_t byte(std::span<const std::byte> bytes) const {
        const auto* begin = reinterpret_cast<const unsigned char*>(bytes.data());
        const unsigned char* next = jpeg.src ? jpeg.src->next_input_byte : nullptr;
        return next >= begin && next <= begin + bytes.size() ? static_cast<std::size_t>(next - begin) : bytes.size();
    }
};

[[noreturn]] void leave(j_common_ptr common) {
    auto* errors = reinterpret_cast<Errors*>(common->err);
    common->err->format_message(common, errors->message);
    const int code = common->err->msg_code;
    errors->ended = code == JWRN_JPEG_EOF || code == JERR_INPUT_EOF || code == JERR_INPUT_EMPTY;
    std::longjmp(errors->jump, 1);
}

/// Level -1 is "the data is corrupt": refused, but for four that do not change a pixel.
void onMessage(j_common_ptr common, int level) {
    const int code = common->err->msg_code;
    const bool harmless = code == JWRN_EXTRANEOUS_DATA || code == JWRN_JFIF_MAJOR || code == JWRN_ADOBE_XFORM || code == JWRN_TOO_MUCH_DATA;
    if (level < 0 && !harmless) leave(common);
}

void onProgress(j_common_ptr common) {
    if (reinterpret_cast<j_decompress_ptr>(common)->input_scan_number > kMaxScans) {
        common->err->msg_code = JERR_BAD_PROGRESSION;
        leave(common);
    }
}

bool readHeader(Reader& reader, const unsigned char* bytes, unsigned long size) {
    if (setjmp(reader.errors.jump)) return false;
    jpeg_create_decompress(&reader.jpeg);
    reader.progress.progress_monitor = onProgress;
    reader.jpeg.progress = &reader.progress;
    jpeg_mem_src(&reader.jpeg, bytes, size);
    jpeg_read_header(&reader.jpeg, TRUE);
    return true;
}

bool start(Reader& reader) {
    if (setjmp(reader.errors.jump)) return false;
    reader.jpeg.out_color_space = reader.jpeg.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    reader.jpeg.dct_method = JDCT_ISLOW;
    jpeg_start_decompress(&reader.jpeg);
    return true;
}

bool readRow(Reader& reader) {
    if (setjmp(reader.errors.jump)) return false;
    JSAMPROW row = reader.row.data();
    jpeg_read_scanlines(&reader.jpeg, &row, 1);
    return true;
}

bool finish(Reader& reader) {
    if (setjmp(reader.errors.jump)) return false;
    jpeg_finish_decompress(&reader.jpeg);
    return true;
}

Error readError(const Encoded& in, const Reader& reader) {
    const std::size_t byte = reader.byte(in.bytes);
    return reader.errors.ended ? truncated(in, byte, "the picture data is cut off") : damaged(in, byte, reader.errors.message);
}

std::optional<Error> refuse(const Encoded& in, const jpeg_decompress_struct& jpeg) {
    if (auto wrong = sizeError(in, jpeg.image_width, jpeg.image_height)) return wrong;
    if (jpeg.num_components != 1 && jpeg.num_components != 3)
        return unsupported(in, fmt::format("a JPEG of {} components", jpeg.num_components), "convert it to RGB");
    if (jpeg.arith_code) return unsupported(in, "an arithmetic-coded JPEG", "save it as baseline or progressive JPEG");
    // Huffman coding spends at least one bit on each 8 x 8 block, so this many bytes are needed before memory is taken by the header's
    // word.
    const std::uint64_t leastBytes = std::uint64_t{jpeg.image_width} * jpeg.image_height / 512;
    if (in.bytes.size() < leastBytes)
        return truncated(in, in.bytes.size(), fmt::format("{} x {} pixels need more bytes", jpeg.image_width, jpeg.image_height));
    return std::nullopt;
}

Result<Image> readPixels(const Encoded& in, Reader& reader) {
    const jpeg_decompress_struct& jpeg = reader.jpeg;
    Image image{.width = static_cast<int>(jpeg.output_width),
                .height = static_cast<int>(jpeg.output_height),
                .channels = jpeg.output_components,
                .bitsPerChannel = 8};
    reader.row.resize(std::size_t{jpeg.output_width} * static_cast<std::size_t>(jpeg.output_components));
    while (jpeg.output_scanline < jpeg.output_height) {
        if (!readRow(reader)) return readError(in, reader);
        for (const unsigned char sample : reader.row)
            image.pixels.push_back(static_cast<float>(sample) / 255.0f);
    }
    if (!finish(reader)) return readError(in, reader);
    return image;
}

constexpr int kQuality = 92; // colour at full resolution: no visible blocks in skin

struct Writer {
    jpeg_compress_struct jpeg{};
    Errors errors;
    unsigned char* bytes = nullptr;
    unsigned long size = 0;

    Writer() = default;
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() {
        jpeg_destroy_compress(&jpeg);
        std::free(bytes); // NOLINT(cppcoreguidelines-no-malloc): libjpeg has allocated it
    }
};

bool writeAll(Writer& writer, const Samples8& samples, const std::string& comment) {
    if (setjmp(writer.errors.jump)) return false;
    jpeg_create_compress(&writer.jpeg);
    jpeg_mem_dest(&writer.jpeg, &writer.bytes, &writer.size);
    writer.jpeg.image_width = samples.width;
    writer.jpeg.image_height = samples.height;
    writer.jpeg.input_components = samples.channels;
    writer.jpeg.in_color_space = samples.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&writer.jpeg);
    jpeg_set_quality(&writer.jpeg, kQuality, TRUE);
    writer.jpeg.comp_info[0].h_samp_factor = writer.jpeg.comp_info[0].v_samp_factor = 1;
    writer.jpeg.optimize_coding = TRUE;
    jpeg_start_compress(&writer.jpeg, TRUE);
    if (!comment.empty())
        jpeg_write_marker(&writer.jpeg, JPEG_COM, reinterpret_cast<const JOCTET*>(comment.data()), static_cast<unsigned>(comment.size()));
    const std::size_t rowBytes = samples.width * static_cast<std::size_t>(samples.channels);
    for (std::size_t y = 0; y < samples.height; ++y) {
        auto* row = const_cast<JSAMPROW>(samples.bytes.data() + y * rowBytes); // libjpeg's row is not const, but it only reads
        jpeg_write_scanlines(&writer.jpeg, &row, 1);
    }
    jpeg_finish_compress(&writer.jpeg);
    return true;
}

} // namespace

Result<Image> decodeJpeg(const Encoded& in) {
    Reader reader;
    reader.jpeg.err = jpeg_std_error(&reader.errors.errors);
    reader.errors.errors.error_exit = leave;
    reader.errors.errors.emit_message = onMessage;
    if (!readHeader(reader, reinterpret_cast<const unsigned char*>(in.bytes.data()), static_cast<unsigned long>(in.bytes.size())))
        return readError(in, reader);
    if (const auto wrong = refuse(in, reader.jpeg)) return *wrong;
    if (!start(reader)) return readError(in, reader);
    return readPixels(in, reader);
}

Result<std::string> encodeJpeg(const Samples8& samples, const std::map<std::string, std::string>& metadata) {
    assert(samples.channels == 1 || samples.channels == 3);
    std::string comment;
    for (const auto& [key, value] : metadata)
        comment.append(key).append(": ").append(value).append("\n");
    comment.resize(std::min<std::size_t>(comment.size(), 65533)); // what a marker holds
    Writer writer;
    writer.jpeg.err = jpeg_std_error(&writer.errors.errors);
    writer.errors.errors.error_exit = leave;
    writer.errors.errors.emit_message = onMessage;
    if (!writeAll(writer, samples, comment)) return machineError(5205, fmt::format("JPEG cannot be encoded: {}", writer.errors.message));
    return std::string(reinterpret_cast<const char*>(writer.bytes), writer.size);
}

} // namespace tegument::codec
