// What the header of an OpenEXR file announces is looked for before memory is taken for it.
// Radiance's pictures, written here byte by byte.

#include "host/image/image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfPreviewImage.h>
#include <ImfStringAttribute.h>
#include <ImfStringVectorAttribute.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <string>

namespace tegument::test {

namespace {

using namespace std::string_literals;

class Memory : public Imf::OStream {
public:
    Memory() : Imf::OStream("memory") {}
    void write(const char source[], int count) override {
        bytes.resize(std::max(bytes.size(), at_ + static_cast<std::size_t>(count)));
        std::memcpy(bytes.data() + at_, source, static_cast<std::size_t>(count));
        at_ += static_cast<std::size_t>(count);
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t place) override { at_ = place; }

    std::string bytes;

private:
    std::uint64_t at_ = 0;
};

Imf::Header header(const std::string& part) {
    Imf::Header header(2, 1);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    header.setPreviewImage(Imf::PreviewImage(1, 1));
    header.insert("words", Imf::StringVectorAttribute({"one", "two"}));
    header.insert("note-" + part, Imf::StringAttribute("text of " + part));
    header.setName(part);
    header.setType(Imf::SCANLINEIMAGE);
    return header;
}

Imf::FrameBuffer frame(std::array<float, 2>& pixels) {
    Imf::FrameBuffer frame;
    frame.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()), sizeof(float), sizeof(pixels)));
    return frame;
}

/// A picture of two pixels in a file of one or two parts.
std::string written(int parts) {
    std::array<float, 2> pixels = {0.25f, 4};
    const std::array headers = {header("first"), header("second")};
    Memory memory;
    if (parts == 1) {
        Imf::OutputFile file(memory, headers[0], 0);
        file.setFrameBuffer(frame(pixels));
        file.writePixels(1);
    } else {
        Imf::MultiPartOutputFile file(memory, headers.data(), parts);
        for (int i = 0; i < parts; ++i) {
            Imf::OutputPart part(file, i);
            part.setFrameBuffer(frame(pixels));
            part.writePixels(1);
        }
    }
    return memory.bytes;
}

Result<Image> exrFrom(const std::string& bytes) {
    return decodeImage(std::as_bytes(std::span(bytes)), "picture.exr");
}

/// The number that stands so far behind these words becomes another.
std::string withNumber(std::string bytes, const std::string& words, std::size_t behind, std::uint32_t number) {
    const std::size_t at = bytes.find(words);
    EXPECT_NE(at, std::string::npos);
    for (std::size_t i = 0; i < 4; ++i)
        bytes[at + words.size() + behind + i] = static_cast<char>(number >> (8 * i));
    return bytes;
}

void expectCutHeader(const std::string& bytes, const std::string& what) {
    const auto image = exrFrom(bytes);
    ASSERT_FALSE(image) << what;
    EXPECT_EQ(image.error().diagnostics.front().code, 5201) << what;
    EXPECT_NE(format(image.error()).find("its header announces more than there is"), std::string::npos) << what << format(image.error());
}

constexpr const char* kHead = "#?RADIANCE\nEXPOSURE=1\nFORMAT=32-bit_rle_rgbe\n\n";

Result<Image> read(const std::string& bytes) {
    return decodeImage(std::as_bytes(std::span(bytes)), "test.hdr");
}

int codeOf(const Result<Image>& image) {
    return image ? 0 : image.error().diagnostics.front().code;
}

std::string bytes(std::initializer_list<int> values) {
    std::string text;
    for (const int value : values)
        text += static_cast<char>(value);
    return text;
}

/// One row of eight pixels in runs: red 128 for all, green 1 to 8, blue 0, exponent 129 (times 2^-7) for all.
std::string runs() {
    return std::string(kHead) + "-Y 1 +X 8\n" +
           bytes({2, 2, 0, 8, 128 + 8, 128, 8, 1, 2, 3, 4, 5, 6, 7, 8, 128 + 8, 0, 128 + 4, 129, 128 + 4, 129});
}

TEST(Hdr, plain_pixels_are_mantissa_times_a_power_of_two) {
    const auto image = read(std::string(kHead) + "-Y 2 +X 1\n" + bytes({128, 64, 0, 129, 200, 100, 50, 136 + 3}));
    ASSERT_TRUE(image) << format(image.error());
    EXPECT_EQ(image->width, 1);
    EXPECT_EQ(image->height, 2);
    EXPECT_EQ(image->pixels, (std::vector<float>{1, 0.5F, 0, 1600, 800, 400}));
}

TEST(Hdr, an_exponent_of_zero_is_black) {
    const auto image = read(std::string(kHead) + "-Y 1 +X 1\n" + bytes({200, 100, 50, 0}));
    ASSERT_TRUE(image) << format(image.error());
    EXPECT_EQ(image->pixels, (std::vector<float>{0, 0, 0}));
}

TEST(Hdr, runs_are_unfolded_channel_by_channel) {
    const auto image = read(runs());
    ASSERT_TRUE(image) << format(image.error());
    for (int x = 0; x < 8; ++x) {
        EXPECT_EQ(image->at(x, 0, 0), 1.0F);
        EXPECT_EQ(image->at(x, 0, 1), static_cast<float>(x + 1) / 128);
        EXPECT_EQ(image->at(x, 0, 2), 0.0F);
    }
}

TEST(Hdr, every_cut_is_an_error_with_its_byte) {
    const std::string whole = runs();
    for (std::size_t size = 11; size < whole.size(); ++size) {
        const auto image = read(whole.substr(0, size));
        EXPECT_EQ(codeOf(image), 5201) << size;
        ASSERT_FALSE(image);
        EXPECT_EQ(image.error().diagnostics.front().at.byte, size) << format(image.error());
    }
}

TEST(Hdr, a_run_beyond_its_row_or_of_nothing_is_damage) {
    std::string tooLong = runs();
    const std::size_t first = tooLong.find(bytes({2, 2, 0, 8})) + 4;
    tooLong[first] = static_cast<char>(128 + 9);
    EXPECT_EQ(codeOf(read(tooLong)), 5202);
    tooLong[first] = 0;
    EXPECT_EQ(codeOf(read(tooLong)), 5202);
}

TEST(Hdr, other_kinds_are_named) {
    EXPECT_EQ(codeOf(read("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + bytes({1, 2, 3, 4}))), 5204);
    EXPECT_EQ(codeOf(read(std::string(kHead) + "+X 1 -Y 1\n" + bytes({1, 2, 3, 4}))), 5204);
    EXPECT_EQ(codeOf(read(std::string(kHead) + "-Y 0 +X 1\n")), 5203);
    EXPECT_EQ(codeOf(read(std::string(kHead) + "-Y 1 +X 999999999999\n")), 5203);
}

} // namespace

TEST(ExrHeaders, of_one_and_of_several_parts_with_every_kind_of_attribute_are_read) {
    for (const int parts : {1, 2}) {
        const auto image = exrFrom(written(parts));
        ASSERT_TRUE(image) << format(image.error());
        EXPECT_EQ(image->at(1, 0, 0), 4);
        EXPECT_EQ(image->metadata.at("note-first"), "text of first");
    }
}

TEST(ExrHeaders, that_announce_more_than_there_is_take_no_memory_and_are_an_error) {
    for (const int parts : {1, 2}) {
        const std::string whole = written(parts);
        expectCutHeader(withNumber(whole, "note-first\0string\0"s, 0, 0x7fffff00), "a string");
        expectCutHeader(withNumber(whole, "words\0stringvector\0"s, 4, 0x7fffff00), "a string of several");
        expectCutHeader(withNumber(whole, "preview\0preview\0"s, 4, 0x1fffff00), "a small picture");
        expectCutHeader(withNumber(whole, "preview\0preview\0"s, 8, 0x1fffff00), "a small picture's rows");
    }
    expectCutHeader(withNumber(written(2), "note-second\0string\0"s, 0, 0x7fffff00), "a string of the second part");
}

} // namespace tegument::test
