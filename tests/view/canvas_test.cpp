// Pictures one after another take no memory, as a viewer that stays open shows them.

#include "host/run/read_back.h"
#include "tools/view/canvas.h"
#include "tools/view/unfold.h"

#include "tests/gpu/with_device.h"

#include <gtest/gtest.h>

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace tegument::view {

namespace {

using Canvases = test::WithDevice;

constexpr int kFirst = 100; // shaders are compiled, pools and caches grow
constexpr int kMore = 100;
/// What caches still grow, 12 KB as measured. A command buffer for each submission kept 11 KB a picture in the validation layer, a shader
/// for each picture 1.1 MB in the driver.
constexpr std::size_t kMostBytes = std::size_t{64} << 10;

gpu::Texture target(gpu::Device& device, std::uint32_t side) {
    auto made = device.createTexture({.name = "t", .format = gpu::Format::RGBA8, .width = side, .height = side, .renderTarget = true});
    EXPECT_TRUE(made);
    return std::move(*made);
}

/// Where a driver that compiles for the processor keeps what it has compiled.
int madeCode() {
    std::ifstream maps("/proc/self/maps");
    int count = 0;
    for (std::string line; std::getline(maps, line);)
        if (line.find(" r-xp ") != std::string::npos && line.find('/') == std::string::npos && line.find('[') == std::string::npos) ++count;
    return count;
}

void showPictures(Canvas& canvas, gpu::Texture& window, gpu::Texture& picture, int count) {
    for (int i = 0; i < count; ++i) // as the viewer: the picture on a texture, that in the window
        ASSERT_TRUE(canvas.show(window, picture, {.channel = i % 5, .toneMap = i % 2 == 0, .encode = i % 3 == 0}));
}

} // namespace

TEST_F(Canvases, pictures_in_a_row_make_no_code_and_take_no_memory) {
    auto canvas = Canvas::create(*device_, Compiler::Dxc);
    ASSERT_TRUE(canvas) << format(canvas.error());
    gpu::Texture window = target(*device_, 32);
    gpu::Texture picture = target(*device_, 16);
    showPictures(*canvas, window, picture, kFirst);
    const int code = madeCode();
    const std::size_t bytes = mallinfo2().uordblks;
    showPictures(*canvas, window, picture, kMore);
    EXPECT_EQ(madeCode(), code) << "the driver compiled shaders anew";
    EXPECT_LT(mallinfo2().uordblks, bytes + kMostBytes);
}

TEST_F(Canvases, what_is_enlarged_stays_in_its_area_of_the_window) {
    auto canvas = Canvas::create(*device_, Compiler::Dxc);
    ASSERT_TRUE(canvas) << format(canvas.error());
    constexpr std::uint32_t kSide = 40;
    gpu::Texture picture = target(*device_, 20);
    gpu::Texture window = target(*device_, kSide);
    std::vector<std::byte> columns; // red goes from 0 to 190 in steps of 10
    for (int i = 0; i < 20 * 20; ++i)
        for (const int value : {i % 20 * 10, 255, 255, 255})
            columns.push_back(static_cast<std::byte>(value));
    ASSERT_TRUE(device_->upload(picture, columns));
    const Canvas::Fit fit{.area = {0.25, 0, 0.75, 0.5}, .fill = false, .closer = {.zoom = 4, .at = {1, 0}}};
    ASSERT_TRUE(canvas->show(window, picture, {}, fit));
    const auto seen = device_->readback(window);
    ASSERT_TRUE(seen);
    const auto at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t channel) {
        return std::to_integer<int>(seen->at(4 * (y * kSide + x) + channel));
    };
    for (std::uint32_t y = 0; y < kSide; ++y)
        for (std::uint32_t x = 0; x < kSide; ++x)
            EXPECT_EQ(at(x, y, 1), x >= 10 && x < 30 && y < 20 ? 255 : 0) << x << ", " << y;
    EXPECT_EQ(at(29, 3, 0), 190) << "the right end stays";
    EXPECT_EQ(at(10, 3, 0), 150) << "a quarter of its columns is seen";
}

TEST_F(Canvases, a_picture_that_is_copied_is_as_one_that_has_levels) {
    auto canvas = Canvas::create(*device_, Compiler::Dxc);
    ASSERT_TRUE(canvas) << format(canvas.error());
    gpu::Texture picture = target(*device_, 20);
    std::vector<std::byte> texels;
    for (int i = 0; i < 4 * 20 * 20; ++i)
        texels.push_back(static_cast<std::byte>(i * 37 % 256));
    ASSERT_TRUE(device_->upload(picture, texels));
    for (const bool fill : {false, true})
        for (const std::uint32_t side : {20U, 33U}) {
            gpu::Texture window = target(*device_, side);
            const auto seen = [&](const Levels& levels) {
                EXPECT_TRUE(canvas->show(window, picture, levels, {.fill = fill, .closer = {}}));
                const auto bytes = device_->readback(window);
                return bytes ? *bytes : std::vector<std::byte>();
            };
            const std::vector<std::byte> copied = seen({});
            EXPECT_FALSE(copied.empty());
            EXPECT_EQ(copied, seen({.offset = {0, 0, 0, 1}})) << "alpha is not shown: the same, by the long way";
        }
}

TEST_F(Canvases, a_cube_unfolds_into_a_cross_of_its_faces_level_by_level) {
    auto cube = device_->createTexture({.name = "c", .format = gpu::Format::R32F, .width = 4, .height = 4, .mips = 3, .cube = true});
    ASSERT_TRUE(cube);
    for (std::uint32_t level = 0; level < 3; ++level)
        for (std::uint32_t face = 0; face < 6; ++face) {
            const std::vector<float> texels(std::size_t{4U >> level} * (4U >> level), static_cast<float>(10 * (face + 1) + level));
            ASSERT_TRUE(device_->upload(*cube, std::as_bytes(std::span(texels)), level, face));
        }
    auto flat = unfolded(*device_, *cube);
    ASSERT_TRUE(flat);
    EXPECT_EQ(flat->desc().mips, 3U);
    for (int level = 0; level < 3; ++level) {
        const auto image = run::readBack(*device_, *flat, static_cast<std::uint32_t>(level));
        ASSERT_TRUE(image);
        const int side = 4 >> level;
        ASSERT_EQ(image->width, 4 * side);
        ASSERT_EQ(image->height, 3 * side);
        const std::array<std::array<int, 4>, 3> faces{{{0, 3, 0, 0}, {2, 5, 1, 6}, {0, 4, 0, 0}}}; // +X is 1, -Z is 6
        for (int y = 0; y < 3 * side; ++y)
            for (int x = 0; x < 4 * side; ++x) {
                const int face = faces.at(static_cast<std::size_t>(y / side)).at(static_cast<std::size_t>(x / side));
                EXPECT_EQ(image->at(x, y, 0), face == 0 ? 0 : static_cast<float>(10 * face + level)) << level << ": " << x << ", " << y;
            }
    }
}

TEST_F(Canvases, what_is_drawn_together_is_what_is_drawn_one_after_another) {
    auto canvas = Canvas::create(*device_, Compiler::Dxc);
    ASSERT_TRUE(canvas) << format(canvas.error());
    gpu::Texture picture = target(*device_, 16);
    ASSERT_TRUE(device_->upload(picture, std::vector<std::byte>(std::size_t{16} * 16 * 4, std::byte{90})));
    // A small picture of the picture, that on the window, and a half transparent triangle on top: each reads what is before it.
    const auto drawAll = [&](gpu::Texture& small, gpu::Texture& window) -> Result<void> {
        const std::array<CanvasVertex, 3> corners{
            {{-1, 1, 0, 0, {1, 0, 0, 0.5F}}, {1, 1, 1, 0, {0, 1, 0, 0.5F}}, {-1, -1, 0, 1, {1, 1, 1, 1}}}};
        const std::array<std::uint32_t, 3> order{0, 1, 2};
        const Canvas::Mesh mesh{.vertices = corners, .indices = order, .texture = &small, .clip = {0, 0, 20, 32}};
        if (auto shown = canvas->show(small, picture, {.encode = true}); !shown) return shown;
        if (auto shown = canvas->show(window, small, {}); !shown) return shown;
        return canvas->blend(window, std::span(&mesh, 1));
    };
    std::array<gpu::Texture, 2> small{target(*device_, 8), target(*device_, 8)}, window{target(*device_, 32), target(*device_, 32)};
    ASSERT_TRUE(drawAll(small[0], window[0]));
    ASSERT_TRUE(canvas->together([&] { return drawAll(small[1], window[1]); }));
    const auto apart = device_->readback(window[0]);
    const auto together = device_->readback(window[1]);
    ASSERT_TRUE(apart && together);
    EXPECT_EQ(*apart, *together);
    EXPECT_GT(std::ranges::count_if(*apart, [](std::byte value) { return value != std::byte{0}; }), 32 * 32) << "there is a picture";

    ASSERT_FALSE(canvas->together([&]() -> Result<void> {
        if (auto shown = canvas->show(window[1], picture, {}); !shown) return shown;
        return inputError(4029, {}, "no");
    }));
    ASSERT_TRUE(canvas->show(small[1], picture, {}));
    const auto still = device_->readback(window[1]);
    ASSERT_TRUE(still);
    EXPECT_EQ(*still, *together) << "what failed was drawn later";
}

} // namespace tegument::view
