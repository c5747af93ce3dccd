#include "host/image/image.h"
#include "host/support/file.h"

#include <gtest/gtest.h>

#include <cstdio>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <half.h>
#include <jpeglib.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <unistd.h>

using namespace tegument;
namespace fs = std::filesystem;

namespace {

class Images : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("tegument-images-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] std::string bytesOf(const fs::path& path) const {
        auto bytes = readFile(path);
        EXPECT_TRUE(bytes);
        return bytes ? *bytes : std::string();
    }

    fs::path folder_;
};

Image ramp(int width, int height, int channels) {
    Image image{.width = width, .height = height, .channels = channels, .bitsPerChannel = 32};
    const int count = width * height * channels;
    for (int i = 0; i < count; ++i)
        image.pixels.push_back(static_cast<float>(i) / static_cast<float>(count - 1));
    return image;
}

Result<Image> decode(const std::string& bytes) {
    return decodeImage(std::as_bytes(std::span(bytes)), "picture");
}

int codeOf(const Result<Image>& image) {
    return image ? 0 : image.error().diagnostics.front().code;
}

/// An 8-bit JPEG of `channels` samples, by libjpeg.
std::string jpeg(int width, int height, int channels, bool progressive) {
    jpeg_compress_struct c{};
    jpeg_error_mgr errors{};
    c.err = jpeg_std_error(&errors);
    jpeg_create_compress(&c);
    unsigned char* buffer = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&c, &buffer, &size);
    c.image_width = static_cast<JDIMENSION>(width);
    c.image_height = static_cast<JDIMENSION>(height);
    c.input_components = channels;
    c.in_color_space = channels == 1 ? JCS_GRAYSCALE : channels == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&c);
    jpeg_set_quality(&c, 100, TRUE);
    if (progressive) jpeg_simple_progression(&c);
    jpeg_start_compress(&c, TRUE);
    std::vector<unsigned char> row(static_cast<std::size_t>(width * channels));
    for (int y = 0; y < height; ++y) {
        std::ranges::fill(row, static_cast<unsigned char>(64 + 2 * y));
        unsigned char* pointer = row.data();
        jpeg_write_scanlines(&c, &pointer, 1);
    }
    jpeg_finish_compress(&c);
    std::string bytes(reinterpret_cast<char*>(buffer), size);
    std::free(buffer);
    jpeg_destroy_compress(&c);
    return bytes;
}

void appendBytes(png_structp png, png_bytep bytes, std::size_t count) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(bytes), count);
}

/// A PNG of any kind, by libpng; `rows` are as the file stores them.
std::string png(unsigned width, unsigned height, int bits, int colorType, std::vector<std::string> rows,
                const std::vector<png_color>& palette = {}, bool interlaced = false) {
    std::string bytes;
    png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(writer);
    png_set_write_fn(writer, &bytes, appendBytes, nullptr);
    png_set_IHDR(writer, info, width, height, bits, colorType, interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (!palette.empty()) png_set_PLTE(writer, info, palette.data(), static_cast<int>(palette.size()));
    png_write_info(writer, info);
    std::vector<png_bytep> pointers;
    for (std::string& row : rows)
        pointers.push_back(reinterpret_cast<png_bytep>(row.data()));
    png_write_image(writer, pointers.data());
    png_write_end(writer, info);
    png_destroy_write_struct(&writer, &info);
    return bytes;
}

} // namespace

TEST(Srgb, both_curves_undo_each_other) {
    for (int i = 0; i <= 1000; ++i) {
        const float x = static_cast<float>(i) / 1000;
        EXPECT_NEAR(srgbToLinear(linearToSrgb(x)), x, 2e-6f) << "float pow has an error of about 1e-7, the slope is at most 12.92";
    }
}

TEST(Srgb, known_values) {
    EXPECT_FLOAT_EQ(srgbToLinear(1), 1);
    EXPECT_FLOAT_EQ(srgbToLinear(0), 0);
    EXPECT_NEAR(srgbToLinear(0.5f), 0.21404114f, 1e-6f); // IEC 61966-2-1 evaluated in double
    EXPECT_NEAR(linearToSrgb(0.18f), 0.46135613f, 1e-6f);
}

TEST(ToneMap, is_the_identity_up_to_the_knee) {
    for (const float x : {0.0f, 0.1f, 0.5f, 0.8f})
        EXPECT_EQ(toneMap(x), x);
}

TEST(ToneMap, never_falls_and_never_exceeds_1) {
    float last = 0;
    for (int i = 0; i < 100000; ++i) {
        const float y = toneMap(static_cast<float>(i) * 1e-3f);
        EXPECT_GE(y, last);
        EXPECT_LE(y, 1);
        last = y;
    }
}

TEST(ToneMap, has_slope_1_on_both_sides_of_the_knee) {
    const float step = 1e-3f;
    EXPECT_NEAR((toneMap(0.8f + step) - toneMap(0.8f)) / step, 1, 0.01f)
        << "the second derivative there is -2 / 0.2, so a step of 1e-3 costs 0.005";
}

TEST(ToneMap, bends_as_documented_above_the_knee) {
    EXPECT_NEAR(toneMap(1), 0.9f, 1e-6f);
    EXPECT_NEAR(toneMap(1.8f), 0.8f + 0.2f * 5 / 6, 1e-6f);
}

TEST(ToneMap, infinite_is_white_and_not_a_number_or_negative_is_black) {
    EXPECT_EQ(toneMap(std::numeric_limits<float>::infinity()), 1);
    EXPECT_EQ(toneMap(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(toneMap(-1), 0);
}

TEST_F(Images, an_exr_returns_every_float_bit_for_bit) {
    for (int channels = 1; channels <= 4; ++channels) {
        Image image = ramp(37, 70, channels); // more than one band of 64 rows
        image.at(3, 5, 0) = 1e-40f;
        image.at(4, 5, 0) = 65536.5f;
        image.at(5, 5, 0) = -std::numeric_limits<float>::infinity();
        ASSERT_TRUE(writeExr(folder_ / "x.exr", image));
        const auto read = loadImage(folder_ / "x.exr");
        ASSERT_TRUE(read) << format(read.error());
        EXPECT_EQ(read->channels, channels);
        EXPECT_EQ(read->bitsPerChannel, 32);
        EXPECT_EQ(read->pixels, image.pixels);
    }
}

TEST_F(Images, an_exr_keeps_metadata_even_under_names_that_openexr_reserves) {
    Image image = ramp(2, 2, 3);
    image.metadata = {{"mesh", "human"}, {"type", "portrait"}, {"channels", "many"}, {"dataWindow", "x"}};
    ASSERT_TRUE(writeExr(folder_ / "x.exr", image));
    const auto read = loadImage(folder_ / "x.exr");
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_EQ(read->metadata, image.metadata);
}

TEST_F(Images, a_half_float_exr_with_a_shifted_data_window_is_read) {
    std::vector<half> y = {half(0.25f), half(0.5f), half(1), half(2)};
    Imf::Header header(Imath::Box2i({0, 0}, {9, 9}), Imath::Box2i({-3, 7}, {-2, 8}));
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    Imf::FrameBuffer frame;
    frame.insert("Y", Imf::Slice::Make(Imf::HALF, y.data(), Imath::V2i(-3, 7), 2, 2, sizeof(half), 2 * sizeof(half)));
    {
        Imf::OutputFile file((folder_ / "x.exr").c_str(), header, 0);
        file.setFrameBuffer(frame);
        file.writePixels(2);
    }
    const auto read = loadImage(folder_ / "x.exr");
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_EQ(read->bitsPerChannel, 16);
    EXPECT_EQ(read->pixels, (std::vector<float>{0.25f, 0.5f, 1, 2}));
}

TEST_F(Images, raw_png_returns_every_8_bit_value_and_the_metadata) {
    for (int channels = 1; channels <= 4; ++channels) {
        Image image = ramp(16, 16, channels);
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i] = static_cast<float>(i % 256) / 255.0f;
        image.metadata = {{"Seed", "7"}, {"Author", "J\xc3\xb6rg"}};
        ASSERT_TRUE(writePng(folder_ / "x.png", image, PngEncoding::Raw));
        const auto read = loadImage(folder_ / "x.png");
        ASSERT_TRUE(read) << format(read.error());
        EXPECT_EQ(read->channels, channels);
        EXPECT_EQ(read->bitsPerChannel, 8);
        EXPECT_EQ(read->pixels, image.pixels);
        EXPECT_EQ(read->metadata, image.metadata);
    }
}

TEST_F(Images, display_png_is_tone_mapped_then_srgb_without_alpha) {
    Image image{.width = 1, .height = 1, .channels = 4, .pixels = {0.18f, 1.0f, 100.0f, 0.5f}, .bitsPerChannel = 32};
    ASSERT_TRUE(writePng(folder_ / "x.png", image, PngEncoding::Display));
    const auto read = loadImage(folder_ / "x.png");
    ASSERT_TRUE(read) << format(read.error());
    ASSERT_EQ(read->channels, 3);
    EXPECT_FLOAT_EQ(read->pixels[0] * 255, 118); // 255 * sRGB(0.18) = 117.6
    EXPECT_FLOAT_EQ(read->pixels[1] * 255, 243); // 255 * sRGB(0.9) = 243.3
    EXPECT_FLOAT_EQ(read->pixels[2] * 255, 255);
}

TEST_F(Images, only_color_png_says_that_it_is_srgb) {
    const Image image = ramp(2, 2, 3);
    const auto color = encodePng(image, PngEncoding::Srgb);
    const auto data = encodePng(image, PngEncoding::Raw);
    ASSERT_TRUE(color && data);
    EXPECT_NE(color->find("sRGB"), std::string::npos);
    EXPECT_EQ(data->find("sRGB"), std::string::npos);
}

TEST_F(Images, not_a_number_and_out_of_range_become_black_or_white) {
    Image image{.width = 3, .height = 1, .channels = 1, .pixels = {NAN, -5, 7}, .bitsPerChannel = 32};
    const auto bytes = encodePng(image, PngEncoding::Raw);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(decode(*bytes)->pixels, (std::vector<float>{0, 0, 1}));
}

TEST(Png, sixteen_bits_keep_their_precision) {
    const auto read = decode(png(2, 1, 16, PNG_COLOR_TYPE_GRAY, {std::string("\x12\x34\xff\xff", 4)}));
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_EQ(read->bitsPerChannel, 16);
    EXPECT_FLOAT_EQ(read->pixels[0], 0x1234 / 65535.0f);
    EXPECT_FLOAT_EQ(read->pixels[1], 1);
}

TEST(Png, palette_and_one_bit_images_become_plain_samples) {
    const auto colors = decode(png(2, 1, 8, PNG_COLOR_TYPE_PALETTE, {std::string("\x01\x00", 2)}, {{255, 0, 0}, {0, 51, 255}}));
    ASSERT_TRUE(colors) << format(colors.error());
    EXPECT_EQ(colors->pixels, (std::vector<float>{0, 0.2f, 1, 1, 0, 0}));
    const auto bits = decode(png(8, 1, 1, PNG_COLOR_TYPE_GRAY, {std::string("\xa0", 1)}));
    ASSERT_TRUE(bits) << format(bits.error());
    EXPECT_EQ(bits->pixels, (std::vector<float>{1, 0, 1, 0, 0, 0, 0, 0}));
}

TEST(Png, interlaced_images_are_read) {
    std::vector<std::string> rows(9);
    for (std::size_t y = 0; y < 9; ++y)
        for (std::size_t x = 0; x < 9; ++x)
            rows[y].push_back(static_cast<char>(9 * y + x));
    const auto read = decode(png(9, 9, 8, PNG_COLOR_TYPE_GRAY, rows, {}, true));
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_FLOAT_EQ(read->at(8, 7, 0) * 255, 71);
}

TEST_F(Images, a_half_exr_returns_halves_bit_for_bit_and_is_smaller) {
    Image image = ramp(64, 64, 4);
    for (float& value : image.pixels)
        value = half(value);
    ASSERT_TRUE(writeExr(folder_ / "half.exr", image, ExrDepth::Half));
    ASSERT_TRUE(writeExr(folder_ / "float.exr", image));
    const auto read = loadImage(folder_ / "half.exr");
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_EQ(read->pixels, image.pixels);
    EXPECT_LT(fs::file_size(folder_ / "half.exr"), fs::file_size(folder_ / "float.exr"));
}

TEST_F(Images, a_jpeg_keeps_smooth_values_within_three_steps) {
    Image image{.width = 32, .height = 32, .channels = 3};
    for (int row = 0; row < 32; ++row)
        for (int column = 0; column < 32; ++column)
            image.pixels.insert(image.pixels.end(), {static_cast<float>(column) / 31, static_cast<float>(row) / 31, 128.0f / 255});
    image.metadata["attribution"] = "Somebody, CC BY 3.0";
    ASSERT_TRUE(writeJpeg(folder_ / "smooth.jpg", image));
    const auto read = loadImage(folder_ / "smooth.jpg");
    ASSERT_TRUE(read) << format(read.error());
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        ASSERT_NEAR(read->pixels[i], image.pixels[i], 3.5f / 255)
            << "quality 92 quantises the first coefficients in steps of 2 to 3, three channels are rounded twice";
    EXPECT_NE(bytesOf(folder_ / "smooth.jpg").find("attribution: Somebody, CC BY 3.0"), std::string::npos);
}

TEST(Jpeg, grey_and_color_baseline_and_progressive_are_read) {
    for (const bool progressive : {false, true}) {
        for (const int channels : {1, 3}) {
            const auto read = decode(jpeg(20, 30, channels, progressive));
            ASSERT_TRUE(read) << format(read.error());
            EXPECT_EQ(read->channels, channels);
            EXPECT_NEAR(read->at(10, 15, 0) * 255, 94, 2) << "quality 100 on a slow ramp: rounding of DCT and colour transform";
        }
    }
}

TEST(Jpeg, cmyk_is_refused_with_a_hint) {
    const auto read = decode(jpeg(8, 8, 4, false));
    EXPECT_EQ(codeOf(read), 5204);
    EXPECT_NE(format(read.error()).find("convert it to RGB"), std::string::npos);
}

TEST_F(Images, every_truncation_is_one_error_with_a_byte_inside_the_file) {
    ASSERT_TRUE(writeExr(folder_ / "x.exr", ramp(40, 70, 3)));
    const auto pngBytes = encodePng(ramp(40, 70, 3), PngEncoding::Raw);
    for (const std::string& whole : {bytesOf(folder_ / "x.exr"), *pngBytes, jpeg(40, 70, 3, false), jpeg(40, 70, 3, true)}) {
        for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 97) {
            const auto read = decode(whole.substr(0, size));
            ASSERT_FALSE(read) << size << " of " << whole.size();
            ASSERT_EQ(read.error().diagnostics.size(), 1u);
            const Diagnostic& diagnostic = read.error().diagnostics.front();
            EXPECT_GE(diagnostic.code, 5200);
            EXPECT_LE(diagnostic.code, 5204);
            ASSERT_TRUE(diagnostic.at.byte) << size << ": " << format(diagnostic);
            EXPECT_LE(*diagnostic.at.byte, size);
        }
    }
}

namespace {

/// Numbers of two and four bytes, the last ones first.
std::string le(std::initializer_list<std::pair<int, std::uint32_t>> numbers) {
    std::string bytes;
    for (auto [count, value] : numbers)
        for (; count > 0; --count, value >>= 8)
            bytes += static_cast<char>(value & 255);
    return bytes;
}

/// `more`: masks or a table of colours, then the rows.
std::string bmp(std::uint32_t width, std::int32_t height, std::uint32_t bits, std::uint32_t packing, std::uint32_t rowsAt,
                const std::string& more) {
    return "BM" +
           le({{4, 0},
               {4, 0},
               {4, rowsAt},
               {4, 40},
               {4, width},
               {4, static_cast<std::uint32_t>(height)},
               {2, 1},
               {2, bits},
               {4, packing},
               {4, 0},
               {4, 0},
               {4, 0},
               {4, 0},
               {4, 0}}) +
           more;
}

std::string tga(std::uint32_t kind, std::uint32_t width, std::uint32_t height, std::uint32_t bits, std::uint32_t way,
                const std::string& more) {
    const std::uint32_t table = kind == 1 ? 2 : 0;
    return le({{1, 0},
               {1, table / 2},
               {1, kind},
               {2, 0},
               {2, table},
               {1, table * 12},
               {2, 0},
               {2, 0},
               {2, width},
               {2, height},
               {1, bits},
               {1, way}}) +
           more;
}

const std::string kRed("\0\0\xff", 3), kBlue("\xff\0\0", 3), kWhite("\xff\xff\xff", 3), kBlack("\0\0\0", 3), kTwo("\0\0", 2);

/// Red, blue; white, black.
const std::vector<float> kFour = {1, 0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0};

std::vector<std::string> bitmaps() {
    const std::string table = kBlack + '\0' + kRed + '\0' + kBlue + '\0' + kWhite + '\0' + std::string(12 * 4, '\0');
    const std::string masks = le({{4, 0xf800}, {4, 0x7e0}, {4, 0x1f}});
    return {bmp(2, 2, 24, 0, 54, kWhite + kBlack + kTwo + kRed + kBlue + kTwo),
            bmp(2, -2, 24, 0, 54, kRed + kBlue + kTwo + kWhite + kBlack + kTwo),
            bmp(2, -2, 32, 0, 54, kRed + "x" + kBlue + "x" + kWhite + "x" + kBlack + "x"),
            bmp(2, -2, 16, 0, 54, le({{2, 0x7c00}, {2, 0x1f}, {2, 0x7fff}, {2, 0}})),
            bmp(2, -2, 16, 3, 66, masks + le({{2, 0xf800}, {2, 0x1f}, {2, 0xffff}, {2, 0}})),
            bmp(2, -2, 4, 0, 118, table + le({{4, 0x12}, {4, 0x30}})),
            tga(2, 2, 2, 24, 0, kWhite + kBlack + kRed + kBlue),
            tga(2, 2, 2, 24, 32, kRed + kBlue + kWhite + kBlack),
            tga(2, 2, 2, 24, 48, kBlue + kRed + kBlack + kWhite),
            tga(2, 2, 2, 16, 32, le({{2, 0x7c00}, {2, 0x1f}, {2, 0x7fff}, {2, 0x8000}})),
            tga(10, 2, 2, 24, 32, '\0' + kRed + "\x02" + kBlue + kWhite + kBlack)};
}

} // namespace

TEST(Bitmaps, of_every_kind_are_read) {
    for (std::size_t i = 0; const std::string& bytes : bitmaps()) {
        const auto image = decode(bytes);
        ASSERT_TRUE(image) << i << format(image.error());
        EXPECT_EQ(image->channels, 3) << i;
        EXPECT_EQ(image->pixels, kFour) << i++;
    }
}

TEST(Bitmaps, of_tables_greys_and_alpha_are_read) {
    EXPECT_EQ(decode(bmp(2, 1, 1, 0, 62, kRed + '\0' + kBlue + '\0' + le({{4, 0x40}})))->pixels, (std::vector<float>{1, 0, 0, 0, 0, 1}));
    EXPECT_EQ(decode(tga(1, 2, 1, 8, 0, kRed + kBlue + le({{1, 1}, {1, 0}})))->pixels, (std::vector<float>{0, 0, 1, 1, 0, 0}));
    EXPECT_EQ(decode(tga(11, 3, 1, 8, 0, "\x82\xff"))->pixels, std::vector<float>(9, 1));
    EXPECT_EQ(decode(tga(2, 1, 1, 32, 8, kRed + '\0'))->pixels, (std::vector<float>{1, 0, 0, 0}));
}

TEST(Bitmaps, that_end_early_or_are_packed_otherwise_are_one_error) {
    for (const std::string& whole : bitmaps())
        for (std::size_t size = 18; size < whole.size(); ++size)
            EXPECT_EQ(codeOf(decode(whole.substr(0, size))), 5201) << size;
    EXPECT_EQ(codeOf(decode(bmp(2, 2, 8, 1, 54, ""))), 5204) << "runs";
    EXPECT_EQ(codeOf(decode(bmp(2, 1, 3, 0, 54, "12345678"))), 5202);
    EXPECT_EQ(codeOf(decode(bmp(70000, 1, 24, 0, 54, ""))), 5203);
    EXPECT_EQ(codeOf(decode(tga(1, 1, 1, 8, 0, kRed + kBlue + "\x07"))), 5202) << "a colour that the table does not have";
}

TEST_F(Images, damage_anywhere_neither_crashes_nor_throws) {
    ASSERT_TRUE(writeExr(folder_ / "x.exr", ramp(40, 70, 3)));
    const auto pngBytes = encodePng(ramp(40, 70, 3), PngEncoding::Raw);
    std::mt19937 random(1);
    for (const std::string& whole :
         {bytesOf(folder_ / "x.exr"), *pngBytes, jpeg(40, 70, 3, false), jpeg(40, 70, 3, true), bitmaps()[5], bitmaps().back()}) {
        for (int round = 0; round < 300; ++round) {
            std::string bytes = whole;
            for (int flips = 0; flips < 3; ++flips)
                bytes[random() % bytes.size()] = static_cast<char>(random());
            const auto read = decode(bytes);
            EXPECT_TRUE(read || !format(read.error()).empty());
        }
    }
}

TEST(ForeignFiles, are_named_by_their_first_bytes) {
    const auto gif = decode("GIF89a~~~");
    EXPECT_EQ(codeOf(gif), 5200);
    EXPECT_NE(format(gif.error()).find("47 49 46"), std::string::npos) << format(gif.error());
    EXPECT_NE(format(decode("").error()).find("empty"), std::string::npos);
}

TEST(HugeImages, are_refused_by_their_size_before_memory_is_taken) {
    std::string bytes = png(1, 1, 8, PNG_COLOR_TYPE_GRAY, {std::string("\0", 1)});
    // IHDR: length 4, type 4, then width; the checksum behind it must fit
    const auto put = [&](std::size_t at, std::uint32_t value) {
        for (std::size_t i = 0; i < 4; ++i)
            bytes[at + i] = static_cast<char>(value >> (24 - 8 * i));
    };
    const auto patch = [&](std::uint32_t width, std::uint32_t height) {
        put(16, width);
        put(20, height);
        std::uint32_t crc = 0xffffffff; // PNG specification, annex D
        for (std::size_t i = 12; i < 29; ++i) {
            crc ^= static_cast<unsigned char>(bytes[i]);
            for (int bit = 0; bit < 8; ++bit)
                crc = crc & 1 ? 0xedb88320u ^ crc >> 1 : crc >> 1;
        }
        put(29, ~crc);
    };
    patch(16385, 1);
    EXPECT_EQ(codeOf(decode(bytes)), 5203);
    patch(16384, 16384);
    EXPECT_EQ(codeOf(decode(bytes)), 5201) << "70 bytes cannot hold 268 million pixels";
}

TEST(MissingImages, are_a_file_error) {
    EXPECT_EQ(codeOf(loadImage("/nowhere/picture.png")), 5001);
}
