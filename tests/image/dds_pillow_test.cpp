// Our DDS files read by somebody else: Pillow, which comes with Debian's matplotlib. It knows eight bits and the first face and level of a
// file.

#include "host/image/dds.h"
#include "host/support/process.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <unistd.h>

using namespace tegument;

namespace {

constexpr int kNoPillow = 77;
constexpr const char* kScript = "import sys\n"
                                "try: from PIL import Image\n"
                                "except ImportError: sys.exit(77)\n"
                                "picture = Image.open(sys.argv[1])\n"
                                "print(*picture.size, picture.convert('RGBA').tobytes().hex(), end='')\n";

/// Every channel of every texel another value, each exactly a byte.
Image distinct(int width, int height) {
    Image image{.width = width, .height = height, .channels = 4, .pixels = {}};
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
        const auto run = runProcess({.arguments = {"/usr/bin/python3", "-c", kScript, file_.string()}, .environment = {}}, 60);
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
