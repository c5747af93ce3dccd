// DDS against bytes laid out by hand after Microsoft's "Programming Guide for DDS" and "DDS_HEADER structure".
// Our DDS files read by somebody else: Pillow, which comes with Debian's matplotlib. It knows eight bits and the first face and level of a
// file.

#include "host/image/dds.h"
#include "host/support/file.h"
#include "tools/process/process.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>

namespace tegument {
namespace {

/// A file as the documentation describes it, 32-bit word by word; words are set by their index in the whole file.
struct Fixture {
    std::string bytes;

    explicit Fixture(bool dx10) : bytes(dx10 ? 148 : 128, '\0') {
        set(0, 0x20534444); // "DDS "
        set(1, 124);
        set(2, 0x1007); // caps, height, width, pixel format
        set(19, 32);
        set(27, 0x1000); // texture
        if (!dx10) return;
        set(20, 4);          // FourCC
        set(21, 0x30315844); // "DX10"
        set(33, 3);          // two-dimensional
        set(35, 1);          // one of them
    }

    Fixture& set(std::size_t word, std::uint32_t value) {
        for (unsigned i = 0; i < 4; ++i)
            bytes[4 * word + i] = static_cast<char>(value >> (8 * i) & 255U);
        return *this;
    }

    Fixture& size(std::uint32_t width, std::uint32_t height) { return set(3, height).set(4, width); }
    Fixture& dxgi(std::uint32_t format) { return set(32, format); }
    Fixture& mips(std::uint32_t count) { return set(2, 0x21007).set(7, count); }
    Fixture& body(std::string_view texels) {
        bytes += texels;
        return *this;
    }
};

Result<DdsTexture> ddsFrom(const std::string& bytes) {
    return decodeDds(std::as_bytes(std::span(bytes)), "texture");
}

template <class T>
const Diagnostic& problem(const Result<T>& result) {
    static const Diagnostic kNone;
    return result ? kNone : result.error().diagnostics.front();
}

/// One error of this code at this byte.
template <class T>
testing::AssertionResult fails(const Result<T>& result, int code, std::size_t byte) {
    if (result) return testing::AssertionFailure() << "it was read";
    const Diagnostic& d = problem(result);
    if (result.error().diagnostics.size() == 1 && d.code == code && d.at.byte == byte) return testing::AssertionSuccess();
    return testing::AssertionFailure() << format(result.error());
}

Image rampOf(int width, int height, int channels) {
    Image image{.width = width, .height = height, .channels = channels};
    for (int i = 0; i < width * height * channels; ++i)
        image.pixels.push_back(static_cast<float>(i % 256) / 255);
    return image;
}

constexpr std::array kEveryFormat = {DdsFormat::Rgba8,   DdsFormat::Rgba8Srgb, DdsFormat::R16F,  DdsFormat::Rg16F,
                                     DdsFormat::Rgba16F, DdsFormat::R32F,      DdsFormat::Rg32F, DdsFormat::Rgba32F};

// ---- Reading files laid out by hand

TEST(Dds, reads_eight_bits_of_red_green_blue_alpha) {
    const auto texture = ddsFrom(Fixture(true).size(2, 1).dxgi(28).body(std::string("\x00\x33\x66\xff\xff\x99\x33\x00", 8)).bytes);
    ASSERT_TRUE(texture) << format(texture.error());
    EXPECT_EQ(texture->at(0, 0).pixels, (std::vector<float>{0, 0.2F, 0.4F, 1, 1, 0.6F, 0.2F, 0}));
    EXPECT_EQ(texture->format, DdsFormat::Rgba8);
}

TEST(Dds, reads_blue_first_files_red_first) {
    for (const std::uint32_t dxgi : {87U, 91U}) {
        const auto texture = ddsFrom(Fixture(true).size(1, 1).dxgi(dxgi).body("\x33\x66\x99\xff").bytes);
        ASSERT_TRUE(texture) << format(texture.error());
        EXPECT_EQ(texture->at(0, 0).pixels, (std::vector<float>{0.6F, 0.4F, 0.2F, 1}));
    }
}

TEST(Dds, reads_halves) {
    // 1, -2, 65504 (the largest), 2^-24 (the smallest)
    const auto texture = ddsFrom(Fixture(true).size(1, 1).dxgi(10).body(std::string("\x00\x3c\x00\xc0\xff\x7b\x01\x00", 8)).bytes);
    ASSERT_TRUE(texture) << format(texture.error());
    EXPECT_EQ(texture->at(0, 0).pixels, (std::vector<float>{1, -2, 65504, std::ldexp(1.0F, -24)}));
}

TEST(Dds, reads_direct3d_9_s_names_of_float_formats) {
    const auto halves =
        ddsFrom(Fixture(false).size(1, 1).set(20, 4).set(21, 113).body(std::string("\x00\x3c\x00\x38\x00\x34\x00\x30", 8)).bytes);
    ASSERT_TRUE(halves) << format(halves.error());
    EXPECT_EQ(halves->at(0, 0).pixels, (std::vector<float>{1, 0.5F, 0.25F, 0.125F}));
    const auto floats = ddsFrom(Fixture(false)
                                    .size(1, 1)
                                    .set(20, 4)
                                    .set(21, 116)
                                    .body(std::string("\x00\x00\x80\x3f\x00\x00\x00\x40\x00\x00\x80\x40\x00\x00\x00\xc1", 16))
                                    .bytes);
    ASSERT_TRUE(floats) << format(floats.error());
    EXPECT_EQ(floats->at(0, 0).pixels, (std::vector<float>{1, 2, 4, -8}));
}

TEST(Dds, reads_direct3d_9_s_a8r8g8b8) {
    const auto texture = ddsFrom(Fixture(false)
                                     .size(1, 1)
                                     .set(20, 0x41)
                                     .set(22, 32)
                                     .set(23, 0xff0000)
                                     .set(24, 0xff00)
                                     .set(25, 0xff)
                                     .set(26, 0xff000000)
                                     .body("\x33\x66\x99\xff")
                                     .bytes);
    ASSERT_TRUE(texture) << format(texture.error());
    EXPECT_EQ(texture->at(0, 0).pixels, (std::vector<float>{0.6F, 0.4F, 0.2F, 1}));
}

TEST(Dds, faces_hold_their_mip_levels_one_after_the_other) {
    std::string texels; // of each face: four texels, then one; all of them its number and level
    for (char face = 0; face < 6; ++face)
        texels += std::string(16, static_cast<char>(face * 2)) + std::string(4, static_cast<char>(face * 2 + 1));
    const auto texture = ddsFrom(Fixture(true).size(2, 2).dxgi(28).mips(2).set(34, 4).body(texels).bytes);
    ASSERT_TRUE(texture) << format(texture.error());
    ASSERT_TRUE(texture->isCube());
    for (int face = 0; face < 6; ++face)
        for (int mip = 0; mip < 2; ++mip)
            EXPECT_EQ(texture->at(face, mip).at(0, 0, 0), static_cast<float>(2 * face + mip) / 255);
}

TEST(Dds, mip_levels_of_an_odd_size_are_rounded_down) {
    const auto texture = ddsFrom(Fixture(true).size(5, 3).dxgi(41).mips(3).body(std::string(4 * (15 + 2 + 1), '\0')).bytes);
    ASSERT_TRUE(texture) << format(texture.error());
    EXPECT_EQ(texture->at(0, 1).width, 2);
    EXPECT_EQ(texture->at(0, 1).height, 1);
    EXPECT_EQ(texture->at(0, 2).width, 1);
}

TEST(Dds, a_mip_count_without_its_flag_is_ignored) {
    const auto texture = ddsFrom(Fixture(true).size(4, 4).dxgi(41).set(7, 3).body(std::string(64, '\0')).bytes);
    ASSERT_TRUE(texture) << format(texture.error());
    EXPECT_EQ(texture->mips, 1);
}

TEST(Dds, is_a_picture_by_its_content) {
    const Fixture file = Fixture(true).size(1, 1).dxgi(28).body("\x33\x66\x99\xff");
    const auto image = decodeImage(std::as_bytes(std::span(file.bytes)), "picture");
    ASSERT_TRUE(image) << format(image.error());
    EXPECT_EQ(image->pixels, (std::vector<float>{0.2F, 0.4F, 0.6F, 1}));
    EXPECT_EQ(image->bitsPerChannel, 8);
}

// ---- Refusing

TEST(DdsErrors, every_cut_is_one_error_at_the_end_of_the_file) {
    const std::string whole = Fixture(true).size(2, 2).dxgi(28).body(std::string(16, 'x')).bytes;
    for (std::size_t length = 4; length < whole.size(); ++length)
        EXPECT_TRUE(fails(ddsFrom(whole.substr(0, length)), 5201, length)) << length;
}

TEST(DdsErrors, bytes_after_the_last_texel_are_refused) {
    EXPECT_TRUE(fails(ddsFrom(Fixture(true).size(2, 2).dxgi(28).body(std::string(17, 'x')).bytes), 5202, 148 + 16));
}

TEST(DdsErrors, a_wrong_header_size_is_named) {
    EXPECT_TRUE(fails(ddsFrom(Fixture(true).set(1, 123).bytes), 5202, 4));
    EXPECT_TRUE(fails(ddsFrom(Fixture(true).set(19, 0).bytes), 5202, 76));
}

TEST(DdsErrors, a_size_beyond_any_device_is_refused_before_memory_is_taken) {
    EXPECT_TRUE(fails(ddsFrom(Fixture(true).size(0xffffffff, 0xffffffff).dxgi(2).bytes), 5203, 12));
    EXPECT_TRUE(fails(ddsFrom(Fixture(true).size(0, 4).dxgi(2).bytes), 5203, 12));
}

TEST(DdsErrors, a_large_claim_in_a_small_file_is_a_cut_file) {
    EXPECT_TRUE(fails(ddsFrom(Fixture(true).size(16384, 16384).dxgi(2).mips(15).set(34, 4).bytes), 5201, 148));
}

TEST(DdsErrors, more_mip_levels_than_the_size_allows_are_refused) {
    EXPECT_TRUE(fails(ddsFrom(Fixture(true).size(4, 4).dxgi(28).mips(4).bytes), 5202, 28));
    EXPECT_TRUE(fails(ddsFrom(Fixture(true).size(4, 4).dxgi(28).mips(0xffffffff).bytes), 5202, 28));
}

TEST(DdsErrors, a_volume_is_refused) {
    EXPECT_TRUE(fails(ddsFrom(Fixture(false).size(4, 4).set(28, 0x200000).set(6, 4).bytes), 5204, 24));
    EXPECT_TRUE(fails(ddsFrom(Fixture(true).size(4, 4).dxgi(28).set(33, 4).bytes), 5204, 132));
}

TEST(DdsErrors, an_array_is_refused) {
    EXPECT_TRUE(fails(ddsFrom(Fixture(true).size(4, 4).dxgi(28).set(35, 2).bytes), 5204, 140));
    EXPECT_TRUE(fails(ddsFrom(Fixture(true).size(4, 4).dxgi(28).set(35, 0xffffffff).bytes), 5204, 140));
}

TEST(DdsErrors, an_unknown_format_is_named_with_its_number) {
    const auto bc1 = ddsFrom(Fixture(true).size(4, 4).dxgi(71).bytes);
    EXPECT_TRUE(fails(bc1, 5204, 128));
    EXPECT_EQ(problem(bc1).text, "a DDS file of DXGI format 71 (0x00000047) cannot be read");
    EXPECT_TRUE(fails(ddsFrom(Fixture(false).size(4, 4).set(20, 4).set(21, 0x31545844).bytes), 5204, 84)); // "DXT1"
}

TEST(DdsErrors, unknown_masks_are_refused) {
    EXPECT_TRUE(fails(ddsFrom(Fixture(false).size(1, 1).set(20, 0x40).set(22, 16).set(23, 0xf800).body("xx").bytes), 5204, 80));
}

TEST(DdsErrors, a_cube_map_with_five_faces_is_refused) {
    EXPECT_TRUE(fails(ddsFrom(Fixture(false).size(1, 1).set(20, 4).set(21, 116).set(28, 0x7e00).bytes), 5204, 112));
}

TEST(DdsErrors, a_cube_map_that_is_not_square_is_refused) {
    EXPECT_TRUE(fails(ddsFrom(Fixture(true).size(2, 1).dxgi(28).set(34, 4).bytes), 5202, 12));
}

TEST(DdsErrors, a_cube_map_is_no_picture) {
    const Fixture file = Fixture(true).size(1, 1).dxgi(28).set(34, 4).body(std::string(24, 'x'));
    EXPECT_EQ(problem(decodeImage(std::as_bytes(std::span(file.bytes)), "picture")).code, 5204);
}

TEST(DdsErrors, another_file_is_told_by_its_first_bytes) {
    EXPECT_TRUE(fails(ddsFrom("PNG"), 5202, 0));
}

// ---- Writing

/// Of the words that the format reserves the seventh says who wrote the file, so that another program's is never replaced unseen.
constexpr std::uint32_t kMark = 0x544d4754; // TGMT

TEST(Dds, writes_the_documented_header) {
    Fixture expected(true);
    expected.size(4, 2).dxgi(2).mips(3).set(2, 0x2100f).set(5, 64).set(27, 0x401008).set(17, kMark);
    const std::string bytes = encodeDds(makeDds(rampOf(4, 2, 4), DdsFormat::Rgba32F, true));
    EXPECT_EQ(bytes.substr(0, 148), expected.bytes);
    EXPECT_EQ(bytes.size(), 148U + 16 * (8 + 2 + 1));
}

TEST(Dds, writes_direct3d_9_s_header) {
    Fixture half(false);
    half.size(4, 1).set(2, 0x100f).set(5, 32).set(7, 1).set(20, 4).set(21, 113).set(17, kMark);
    EXPECT_EQ(encodeDds(makeDds(rampOf(4, 1, 4), DdsFormat::Rgba16F, false), DdsHeader::Direct3D9).substr(0, 128), half.bytes);
    Fixture bytes(false);
    bytes.size(1, 1).set(2, 0x100f).set(5, 4).set(7, 1).set(20, 0x41).set(22, 32).set(17, kMark);
    bytes.set(23, 0xff0000).set(24, 0xff00).set(25, 0xff).set(26, 0xff000000).body("\x33\x66\x99\xff");
    const Image color{.width = 1, .height = 1, .channels = 4, .pixels = {0.6F, 0.4F, 0.2F, 1}};
    EXPECT_EQ(encodeDds(makeDds(color, DdsFormat::Rgba8, false), DdsHeader::Direct3D9), bytes.bytes);
}

TEST(Dds, every_format_returns_what_it_can_hold) {
    for (const DdsFormat format : kEveryFormat)
        for (const DdsHeader header : {DdsHeader::Dx10, DdsHeader::Direct3D9}) {
            DdsTexture written = makeDds(rampOf(5, 3, channelCount(format)), format, true);
            const auto once = ddsFrom(encodeDds(written, header)); // quantised
            ASSERT_TRUE(once) << name(format) << tegument::format(once.error());
            const auto twice = ddsFrom(encodeDds(*once, header));
            ASSERT_TRUE(twice) << name(format);
            ASSERT_EQ(twice->mips, 3);
            for (int mip = 0; mip < 3; ++mip)
                EXPECT_EQ(once->at(0, mip).pixels, twice->at(0, mip).pixels) << name(format);
            const float step = channelCount(format) == 4 && once->at(0, 0).bitsPerChannel == 8 ? 0.5F / 255 : 1.0F / 2048; // half: 11 bits
            for (std::size_t i = 0; i < written.images.front().pixels.size(); ++i)
                EXPECT_NEAR(once->at(0, 0).pixels[i], written.images.front().pixels[i], step) << name(format);
        }
}

TEST(Dds, floats_return_bit_for_bit) {
    Image image{.width = 4, .height = 1, .channels = 1, .pixels = {std::numeric_limits<float>::denorm_min(), -0.0F, 1e38F, 1.0F / 3}};
    const auto read = ddsFrom(encodeDds(makeDds(image, DdsFormat::R32F, false)));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->at(0, 0).pixels, image.pixels);
}

TEST(Dds, a_cube_map_returns) {
    DdsTexture cube{.format = DdsFormat::Rgba8, .faces = 6, .mips = 1};
    for (int face = 0; face < 6; ++face)
        cube.images.push_back({.width = 1, .height = 1, .channels = 4, .pixels = std::vector<float>(4, static_cast<float>(face) / 5)});
    for (const DdsHeader header : {DdsHeader::Dx10, DdsHeader::Direct3D9}) {
        const auto read = ddsFrom(encodeDds(cube, header));
        ASSERT_TRUE(read) << format(read.error());
        ASSERT_TRUE(read->isCube());
        for (int face = 0; face < 6; ++face)
            EXPECT_EQ(read->at(face, 0).pixels, cube.at(face, 0).pixels);
    }
}

TEST(Dds, a_mip_level_is_the_mean_of_what_it_covers) {
    const Image image{.width = 3, .height = 1, .channels = 1, .pixels = {3, 6, 12}};
    const DdsTexture texture = makeDds(image, DdsFormat::R32F, true);
    ASSERT_EQ(texture.mips, 2);
    EXPECT_FLOAT_EQ(texture.at(0, 1).pixels.front(), 7) << "the mean of three, none of them left out";
}

TEST(Dds, mip_levels_of_srgb_are_means_of_light) {
    const Image image{.width = 2, .height = 1, .channels = 4, .pixels = {0, 0, 0, 0, 1, 1, 1, 1}};
    const DdsTexture texture = makeDds(image, DdsFormat::Rgba8Srgb, true);
    EXPECT_NEAR(texture.at(0, 1).pixels[0], linearToSrgb(0.5F), 1e-6F) << "float pow has an error of about 1e-7";
    EXPECT_FLOAT_EQ(texture.at(0, 1).pixels[3], 0.5F) << "alpha is linear";
}

TEST(Dds, grey_is_spread_and_a_missing_alpha_is_one) {
    const Image image{.width = 1, .height = 1, .channels = 1, .pixels = {0.25F}};
    EXPECT_EQ(makeDds(image, DdsFormat::Rgba32F, false).at(0, 0).pixels, (std::vector<float>{0.25F, 0.25F, 0.25F, 1}));
}

TEST(Dds, nan_in_eight_bits_is_zero) {
    const Image image{.width = 1, .height = 1, .channels = 4, .pixels = std::vector<float>(4, std::nanf(""))};
    const auto read = ddsFrom(encodeDds(makeDds(image, DdsFormat::Rgba8, false)));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->at(0, 0).pixels, std::vector<float>(4, 0));
}

constexpr int kNoPillow = 77;
constexpr const char* kScript = "import sys\n"
                                "try: from PIL import Image\n"
                                "except ImportError: sys.exit(77)\n"
                                "picture = Image.open(sys.argv[1])\n"
                                "print(*picture.size, picture.convert('RGBA').tobytes().hex(), end='')\n";

/// Every channel of every texel another value, each exactly a byte.
Image distinct(int width, int height) {
    Image image{.width = width, .height = height, .channels = 4};
    for (int i = 0; i < 4 * width * height; ++i)
        image.pixels.push_back(static_cast<float>(11 + 3 * i) / 255);
    return image;
}

/// "width height" and the bytes of red, green, blue and alpha in hexadecimal digits.
std::string described(const Image& image) {
    std::string text = fmt::format("{} {} ", image.width, image.height);
    for (const float value : image.pixels)
        text += fmt::format("{:02x}", static_cast<int>(std::floor(value * 255 + 0.5F)));
    return text;
}

class DdsInPillow : public testing::TestWithParam<DdsHeader> {
protected:
    void TearDown() override {
        std::error_code code;
        std::filesystem::remove(file_, code);
    }

    /// The same of what Pillow finds; none where it is not installed.
    std::optional<std::string> read(const DdsTexture& texture) {
        const auto written = writeDds(file_, texture, GetParam());
        EXPECT_TRUE(written) << format(written.error());
        const auto run = runProcess({.arguments = {"/usr/bin/python3", "-c", kScript, file_.string()}}, 60);
        if (!run || run->exitCode == kNoPillow) return std::nullopt;
        EXPECT_EQ(run->exitCode, 0) << run->output;
        return run->output;
    }

private:
    std::filesystem::path file_ = std::filesystem::temp_directory_path() / fmt::format("tegument-pillow-{}.dds", ::getpid());
};

const auto kName = [](const auto& each) { return each.param == DdsHeader::Dx10 ? "Dx10" : "Direct3D9"; };

} // namespace

TEST_P(DdsInPillow, has_the_texels_that_were_written) {
    const Image image = distinct(3, 2); // rows of 12 bytes: no power of two to hide behind
    const auto seen = read(makeDds(image, DdsFormat::Rgba8, false));
    if (!seen) GTEST_SKIP() << "no Pillow in /usr/bin/python3";
    EXPECT_EQ(*seen, described(image));
}

TEST_P(DdsInPillow, finds_the_largest_level_first) {
    const Image image = distinct(4, 4);
    const auto seen = read(makeDds(image, DdsFormat::Rgba8, true));
    if (!seen) GTEST_SKIP() << "no Pillow in /usr/bin/python3";
    EXPECT_EQ(*seen, described(image));
}

TEST_P(DdsInPillow, takes_encoded_bytes_as_they_are) {
    const Image image = distinct(2, 2);
    const auto seen = read(makeDds(image, DdsFormat::Rgba8Srgb, false));
    if (!seen) GTEST_SKIP() << "no Pillow in /usr/bin/python3";
    EXPECT_EQ(*seen, described(image));
}

INSTANTIATE_TEST_SUITE_P(Headers, DdsInPillow, testing::Values(DdsHeader::Dx10, DdsHeader::Direct3D9), kName);

} // namespace tegument
