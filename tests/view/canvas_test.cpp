// Pictures one after another take no memory, as a viewer that stays open shows them.

#include "host/view/canvas.h"
#include "host/view/kept_buffers.h"

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

TEST_F(Canvases, what_is_drawn_again_is_in_the_same_buffers_and_what_is_not_is_given_back) {
    const std::uint64_t before = device_->allocatedBytes();
    KeptBuffers buffers(*device_);
    const std::vector<std::uint32_t> text{1, 2, 3}, other{1, 2, 4};
    const auto asked = [&](gpu::BufferUsage usage, const std::vector<std::uint32_t>& numbers) {
        const auto buffer = buffers.with(usage, std::as_bytes(std::span(numbers)));
        EXPECT_TRUE(buffer);
        return *buffer;
    };
    gpu::Buffer* first = asked(gpu::BufferUsage::Index, text);
    EXPECT_NE(asked(gpu::BufferUsage::Vertex, text), first);
    EXPECT_NE(asked(gpu::BufferUsage::Index, other), first);
    for (int draw = 0; draw < 2 * KeptBuffers::kKept; ++draw) {
        buffers.nextDraw();
        EXPECT_EQ(asked(gpu::BufferUsage::Index, text), first);
    }
    EXPECT_EQ(buffers.count(), 1U) << "the others were not asked for";
    const auto bytes = device_->readback(*first);
    ASSERT_TRUE(bytes);
    EXPECT_TRUE(std::ranges::equal(*bytes, std::as_bytes(std::span(text))));
    for (int draw = 0; draw <= KeptBuffers::kKept; ++draw)
        buffers.nextDraw();
    EXPECT_EQ(buffers.count(), 0U);
    EXPECT_EQ(device_->allocatedBytes(), before);
}

} // namespace tegument::view
