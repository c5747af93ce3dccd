// `render --turntable -o x.gif`, read again by giflib's decoder.
#include "tests/cli/picture.h"
#include "tests/cli/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include <gif_lib.h>

using namespace tegument::test;
namespace fs = std::filesystem;

namespace {

using File = std::unique_ptr<GifFileType, void (*)(GifFileType*)>;

File readGif(const fs::path& path) {
    File file(DGifOpenFileName(path.c_str(), nullptr), [](GifFileType* opened) { DGifCloseFile(opened, nullptr); });
    if (file && DGifSlurp(file.get()) != GIF_OK) file.reset();
    return file;
}

/// Mean of the absolute differences of the three channels, of 0..1.
double framesApart(const SavedImage& picture, const tegument::Image& image) {
    if (picture.ImageDesc.Width != image.width || picture.ImageDesc.Height != image.height || !picture.ImageDesc.ColorMap) return 1e9;
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const GifColorType& colour = picture.ImageDesc.ColorMap->Colors[picture.RasterBits[y * image.width + x]];
            sum += std::abs(colour.Red / 255.0 - static_cast<double>(image.at(x, y, 0)));
            sum += std::abs(colour.Green / 255.0 - static_cast<double>(image.at(x, y, 1)));
            sum += std::abs(colour.Blue / 255.0 - static_cast<double>(image.at(x, y, 2)));
        }
    return sum / (3.0 * image.width * image.height);
}

Ran renderTurning(const fs::path& file) {
    return tegument::test::tegument(
        {"render", "effects/Specular.fx", "-w", ballWorkspace(), "--size", "96", "--turntable", "5", "-o", file.string()});
}

} // namespace

TEST(Gif, looks_like_the_pngs_of_the_turntable) {
    const Ran ran = renderTurning(scratch() / "turn.GIF");
    ASSERT_EQ(ran.code, 0) << ran.err;
    ASSERT_EQ(renderTurning(scratch() / "turn.png").code, 0);
    const File gif = readGif(scratch() / "turn.GIF");
    ASSERT_TRUE(gif);
    ASSERT_EQ(gif->ImageCount, 5);
    for (int i = 0; i < 5; ++i) {
        const auto png = tegument::loadImage(scratch() / fmt::format("turn-{:03}.png", i + 1));
        ASSERT_TRUE(png);
        EXPECT_LT(framesApart(gif->SavedImages[i], *png), 0.01) << "256 colours move no value by more than a hundredth, on the mean";
    }
}

TEST(Gif, turns_once_in_four_seconds_and_for_ever) {
    ASSERT_EQ(renderTurning(scratch() / "turn.gif").code, 0);
    const File gif = readGif(scratch() / "turn.gif");
    ASSERT_TRUE(gif);
    ASSERT_GE(gif->ImageCount, 1);
    for (int i = 0; i < gif->ImageCount; ++i) {
        GraphicsControlBlock control{};
        ASSERT_EQ(DGifSavedExtensionToGCB(gif.get(), i, &control), GIF_OK);
        EXPECT_EQ(control.DelayTime, 80) << "hundredths of a second";
    }
    const SavedImage& first = gif->SavedImages[0];
    ASSERT_GE(first.ExtensionBlockCount, 2);
    const auto text = [&](int i) {
        return std::string(reinterpret_cast<const char*>(first.ExtensionBlocks[i].Bytes),
                           static_cast<std::size_t>(first.ExtensionBlocks[i].ByteCount));
    };
    EXPECT_EQ(text(0), "NETSCAPE2.0");
    EXPECT_EQ(text(1), std::string("\1\0\0", 3)) << "without end";
}
