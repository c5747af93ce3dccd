// What a draw writes, and where.

#include "tests/gpu/fixture.h"

#include "shaders/color_frag.h"
#include "shaders/gaps_frag.h"
#include "shaders/mesh_vert.h"
#include "shaders/mrt_frag.h"
#include "shaders/uniform_frag.h"
#include "shaders/uv_frag.h"

#include <cmath>

namespace tegument::gpu {
namespace {

struct PlaneVertex {
    Pixel position;
    Pixel color;
};

constexpr Pixel kWhite = {1, 1, 1, 1};

class Draws : public Gpu {
protected:
    static PipelineDesc mesh(Topology topology = Topology::TriangleList) {
        PipelineDesc desc = screen(color_frag, {}, {Format::RGBA32F});
        desc.vertex = {.spirv = mesh_vert, .entry = "main"};
        desc.attributes = {{.location = 0, .components = 4, .offset = 0}, {.location = 1, .components = 4, .offset = 16}};
        desc.vertexStride = sizeof(PlaneVertex);
        desc.topology = topology;
        return desc;
    }

    /// The pixels (of a 16 x 16 target) that became white.
    std::vector<std::array<int, 2>> covered(const Targets& targets) {
        std::vector<std::array<int, 2>> list;
        const auto all = pixels(*targets.colors.front());
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                if (all[static_cast<std::size_t>(y * 16 + x)] == kWhite) list.push_back({x, y});
        return list;
    }
};

/// Pixel edges of a 16 x 16 target in Direct3D's clip space, pixel (0, 0) at the top left.
Pixel corner(float x, float y) {
    return {x / 8.0f - 1.0f, 1.0f - y / 8.0f, 0.5f, 1.0f};
}

/// A rectangle as a strip.
std::array<PlaneVertex, 4> rectangle(float left, float top, float right, float bottom) {
    return {{{corner(left, top), kWhite}, {corner(right, top), kWhite}, {corner(left, bottom), kWhite}, {corner(right, bottom), kWhite}}};
}

TEST_F(Draws, texel_row_0_is_the_top_of_clip_space) {
    Texture image = target(Format::RGBA32F, 4, 4);
    const Pipeline pipeline = must(device().createPipeline(screen(uv_frag, {}, {Format::RGBA32F})));
    must(drawOnce({.colors = {&image}}, screenDraw(pipeline)));
    const auto all = pixels(image);
    EXPECT_EQ(all[0], (Pixel{0.125f, 0.125f, 0.5f, 0.5f}));
    EXPECT_EQ(all[3], (Pixel{0.875f, 0.125f, 3.5f, 0.5f}));
    EXPECT_EQ(all[12], (Pixel{0.125f, 0.875f, 0.5f, 3.5f}));
}

TEST_F(Draws, a_rectangle_covers_exactly_the_pixels_whose_centres_it_holds) {
    Texture image = target(Format::RGBA32F, 16, 16);
    const Pipeline pipeline = must(device().createPipeline(mesh(Topology::TriangleStrip)));
    const Buffer vertices = must(device().createBuffer(BufferUsage::Vertex, bytesOf(rectangle(3, 1, 6, 3))));
    const Targets targets{.colors = {&image}};
    must(drawOnce(targets, {.pipeline = &pipeline, .vertices = &vertices, .count = 4}));
    EXPECT_EQ(covered(targets), (std::vector<std::array<int, 2>>{{3, 1}, {4, 1}, {5, 1}, {3, 2}, {4, 2}, {5, 2}}));
}

TEST_F(Draws, indices_and_instances_are_honoured) {
    Texture image = target(Format::RGBA32F, 16, 16);
    const Pipeline pipeline = must(device().createPipeline(mesh()));
    const Buffer vertices = must(device().createBuffer(BufferUsage::Vertex, bytesOf(rectangle(2, 5, 3, 6))));
    const Buffer indices = must(device().createBuffer(BufferUsage::Index, bytesOf(std::array<std::uint32_t, 8>{9, 9, 0, 1, 2, 2, 1, 3})));
    const Targets targets{.colors = {&image}};
    must(drawOnce(targets, {.pipeline = &pipeline, .vertices = &vertices, .indices = &indices, .first = 2, .count = 6, .instances = 3}));
    EXPECT_EQ(covered(targets), (std::vector<std::array<int, 2>>{{2, 5}, {3, 5}, {4, 5}}));
}

TEST_F(Draws, first_skips_vertices) {
    Texture image = target(Format::RGBA32F, 16, 16);
    const Pipeline pipeline = must(device().createPipeline(mesh(Topology::TriangleStrip)));
    const auto skipped = rectangle(0, 0, 16, 16);
    const auto drawn = rectangle(7, 7, 8, 8);
    std::vector<PlaneVertex> all(skipped.begin(), skipped.end());
    all.insert(all.end(), drawn.begin(), drawn.end());
    const Buffer vertices = must(device().createBuffer(BufferUsage::Vertex, bytesOf(all)));
    const Targets targets{.colors = {&image}};
    must(drawOnce(targets, {.pipeline = &pipeline, .vertices = &vertices, .first = 4, .count = 4}));
    EXPECT_EQ(covered(targets), (std::vector<std::array<int, 2>>{{7, 7}}));
}

TEST_F(Draws, bytes_of_vertices_and_indices_are_copied_when_the_draw_is_recorded) {
    Texture image = target(Format::RGBA32F, 16, 16);
    const Pipeline pipeline = must(device().createPipeline(mesh()));
    const std::array<std::uint32_t, 6> order{0, 1, 2, 2, 1, 3};
    const Targets targets{.colors = {&image}};
    must(device().run([&](Recorder& recorder) -> Result<void> {
        auto place = rectangle(2, 5, 3, 6);
        std::array<std::uint32_t, 7> indices{9, 0, 1, 2, 2, 1, 3};
        Draw draw{.pipeline = &pipeline, .vertexBytes = bytesOf(place), .indexBytes = bytesOf(indices), .first = 1, .count = 6};
        must(recorder.draw(targets, draw));
        place = rectangle(7, 7, 8, 8); // another rectangle in the same bytes
        must(recorder.draw(targets, draw));
        place = rectangle(0, 0, 16, 16);
        indices.fill(0);
        return {};
    }));
    EXPECT_EQ(covered(targets), (std::vector<std::array<int, 2>>{{2, 5}, {7, 7}}));
    const Buffer vertices = must(device().createBuffer(BufferUsage::Vertex, bytesOf(rectangle(9, 9, 10, 10))));
    must(drawOnce(targets, {.pipeline = &pipeline, .vertices = &vertices, .indexBytes = bytesOf(order), .count = 6}));
    EXPECT_EQ(covered(targets), (std::vector<std::array<int, 2>>{{2, 5}, {7, 7}, {9, 9}}));
}

TEST_F(Draws, eight_targets_of_different_formats_each_get_their_own_value) {
    const std::vector<Format> formats = {Format::RGBA8, Format::BGRA8, Format::RGBA16,  Format::RGB10A2,
                                         Format::R16F,  Format::R32F,  Format::RGBA16F, Format::RGBA32F};
    std::vector<Texture> images;
    for (const Format format : formats)
        images.push_back(target(format, 2, 2));
    Targets targets;
    for (Texture& image : images)
        targets.colors.push_back(&image);
    const Pipeline pipeline = must(device().createPipeline(screen(mrt_frag, {}, formats)));
    must(drawOnce(targets, screenDraw(pipeline)));

    // The shader writes (i + 1) / 8 as red of target i, 0.5 as green, 0.25 as blue.
    const auto first = [&]<class T>(std::size_t i, T) { return fromBytes<T>(must(device().readback(images[i]))).front(); };
    EXPECT_NEAR(first(0, std::uint8_t{}), 255.0 / 8, 1); // either neighbour of a tie
    EXPECT_NEAR(first(1, std::uint8_t{}), 255.0 / 4, 1); // blue first
    EXPECT_NEAR(first(2, std::uint16_t{}), 65535.0 * 3 / 8, 1);
    EXPECT_NEAR(first(3, std::uint32_t{}) & 1023u, 1023.0 * 4 / 8, 1); // red in the low bits
    EXPECT_EQ(first(4, std::uint16_t{}), 0x3900);                      // 5/8 as a half: 1.25 * 2^-1
    EXPECT_EQ(first(5, float{}), 0.75f);
    EXPECT_EQ(first(6, std::uint16_t{}), 0x3b00); // 7/8: 1.75 * 2^-1
    EXPECT_EQ(first(7, float{}), 1.0f);
}

TEST_F(Draws, sets_without_bindings_between_others_are_no_obstacle) {
    Texture image = target(Format::RGBA32F, 1, 1);
    const Pipeline pipeline = must(device().createPipeline(screen(gaps_frag, {{3, 7}, {0, 5}}, {Format::RGBA32F})));
    const Pixel a = {1, 2, 3, 4};
    const Pixel b = {10, 20, 30, 40};
    must(drawOnce({.colors = {&image}}, screenDraw(pipeline, {{0, 5, bytesOf(a)}, {3, 7, bytesOf(b)}})));
    EXPECT_EQ(pixels(image).front(), (Pixel{11, 22, 33, 44}));
}

TEST_F(Draws, uniform_bytes_are_copied_when_the_draw_is_recorded) {
    Texture images[2] = {target(Format::RGBA32F, 1, 1), target(Format::RGBA32F, 1, 1)};
    const Pipeline pipeline = must(device().createPipeline(screen(uniform_frag, {{0, 0}}, {Format::RGBA32F})));
    Pixel color = {1, 2, 3, 4};
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.draw({.colors = {&images[0]}}, screenDraw(pipeline, {{0, 0, bytesOf(color)}})));
        color = {5, 6, 7, 8};
        return recorder.draw({.colors = {&images[1]}}, screenDraw(pipeline, {{0, 0, bytesOf(color)}}));
    }));
    EXPECT_EQ(pixels(images[0]).front(), (Pixel{1, 2, 3, 4}));
    EXPECT_EQ(pixels(images[1]).front(), (Pixel{5, 6, 7, 8}));
}

TEST_F(Draws, thousands_of_draws_in_a_frame_each_keep_their_uniforms) {
    // 3,000 draws with 4 KiB each overflow the first uniform chunk and the first descriptor pools many times.
    constexpr int kDraws = 3000;
    Texture image = target(Format::RGBA32F, 1, 1);
    PipelineDesc desc = screen(uniform_frag, {{0, 0}}, {Format::RGBA32F});
    desc.state.targets[0] = {.enable = true, .src = BlendFactor::One, .dst = BlendFactor::One};
    const Pipeline pipeline = must(device().createPipeline(desc));
    std::vector<Pixel> block(256, Pixel{});
    double expected = 0;
    must(device().run([&](Recorder& recorder) -> Result<void> {
        for (int i = 1; i <= kDraws; ++i) {
            block[0][0] = static_cast<float>(i);
            expected += i;
            must(recorder.draw({.colors = {&image}}, screenDraw(pipeline, {{0, 0, bytesOf(block)}})));
        }
        return {};
    }));
    EXPECT_EQ(pixels(image).front()[0], static_cast<float>(expected)); // 4,501,500 < 2^24: every partial sum is exact
}

TEST_F(Draws, a_second_frame_may_use_the_same_arenas_again) {
    Texture image = target(Format::RGBA32F, 1, 1);
    const Pipeline pipeline = must(device().createPipeline(screen(uniform_frag, {{0, 0}}, {Format::RGBA32F})));
    for (const float value : {1.0f, 2.0f, 3.0f}) {
        const Pixel color = {value, value, value, value};
        must(drawOnce({.colors = {&image}}, screenDraw(pipeline, {{0, 0, bytesOf(color)}})));
        EXPECT_EQ(pixels(image).front(), color);
    }
}

} // namespace
} // namespace tegument::gpu
