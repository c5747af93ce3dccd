// Direct3D's render states, each judged by pixels.

#include "tests/gpu/fixture.h"

#include "shaders/color_frag.h"
#include "shaders/dual_frag.h"
#include "shaders/mesh_vert.h"
#include "shaders/uniform_frag.h"

#include <algorithm>
#include <cmath>

namespace tegument::gpu {
namespace {

struct Vertex {
    Pixel position;
    Pixel color;
};

class States : public Gpu {
protected:
    /// A target of 8 x 8 with a depth texture, both cleared.
    void clear(float depth, Format depthFormat = Format::D32F) {
        color_ = target(Format::RGBA32F, 8, 8);
        depth_ = target(depthFormat, 8, 8);
        must(device().run([&](Recorder& recorder) -> Result<void> {
            must(recorder.clearColor(color_, {0, 0, 0, 0}));
            return recorder.clearDepthStencil(depth_, depth, std::nullopt);
        }));
    }

    void draw(const PipelineState& state, std::span<const Vertex> vertices, float clearDepth = 1.0f) {
        clear(clearDepth);
        drawMore(state, vertices);
    }

    /// One triangle list over what is there.
    void drawMore(const PipelineState& state, std::span<const Vertex> vertices) {
        PipelineDesc desc = screen(color_frag, {}, {Format::RGBA32F});
        desc.vertex = {.spirv = mesh_vert, .entry = "main"};
        desc.attributes = {{.location = 0, .components = 4, .offset = 0}, {.location = 1, .components = 4, .offset = 16}};
        desc.vertexStride = sizeof(Vertex);
        desc.depthFormat = depth_.desc().format;
        desc.state = state;
        const Pipeline pipeline = must(device().createPipeline(desc));
        const Buffer buffer = must(device().createBuffer(BufferUsage::Vertex, std::as_bytes(vertices)));
        must(drawOnce({.colors = {&color_}, .depth = &depth_},
                      {.pipeline = &pipeline, .vertices = &buffer, .count = static_cast<std::uint32_t>(vertices.size())}));
    }

    Pixel middle() { return pixels(color_)[4 * 8 + 4]; }
    bool drawn() { return middle()[3] != 0; }
    float depthInTheMiddle() { return floats(depth_)[4 * 8 + 4]; }

    Texture color_;
    Texture depth_;
};

/// Covers the whole target at one depth; counter-clockwise on screen (y up): bottom left, bottom right, top.
std::array<Vertex, 3> counterClockwise(float z = 0.5f, Pixel color = kRed) {
    return {{{{-4, -4, z, 1}, color}, {{4, -4, z, 1}, color}, {{0, 4, z, 1}, color}}};
}

std::array<Vertex, 3> clockwise() {
    auto triangle = counterClockwise();
    std::swap(triangle[0], triangle[1]);
    return triangle;
}

PipelineState plain() {
    return {.cull = CullMode::None};
}

TEST_F(States, nothing_is_culled_by_cull_none) {
    for (const bool front : {false, true}) {
        const PipelineState state{.cull = CullMode::None, .frontCounterClockwise = front};
        draw(state, counterClockwise());
        EXPECT_TRUE(drawn());
        draw(state, clockwise());
        EXPECT_TRUE(drawn());
    }
}

TEST_F(States, clockwise_triangles_are_the_front_by_default) {
    draw({.cull = CullMode::Back}, clockwise());
    EXPECT_TRUE(drawn());
    draw({.cull = CullMode::Back}, counterClockwise());
    EXPECT_FALSE(drawn());
    draw({.cull = CullMode::Front}, clockwise());
    EXPECT_FALSE(drawn());
    draw({.cull = CullMode::Front}, counterClockwise());
    EXPECT_TRUE(drawn());
}

TEST_F(States, counter_clockwise_triangles_are_the_front_when_the_state_says_so) {
    draw({.cull = CullMode::Back, .frontCounterClockwise = true}, counterClockwise());
    EXPECT_TRUE(drawn());
    draw({.cull = CullMode::Back, .frontCounterClockwise = true}, clockwise());
    EXPECT_FALSE(drawn());
    draw({.cull = CullMode::Front, .frontCounterClockwise = true}, counterClockwise());
    EXPECT_FALSE(drawn());
    draw({.cull = CullMode::Front, .frontCounterClockwise = true}, clockwise());
    EXPECT_TRUE(drawn());
}

struct DepthCase {
    CompareOp op;
    bool whenNearer, whenEqual, whenFarther; // passes for a fragment at 0.25, 0.5, 0.75 against 0.5
};

class DepthCompares : public States, public ::testing::WithParamInterface<DepthCase> {};

TEST_P(DepthCompares, as_its_name_says) {
    PipelineState state = plain();
    state.depthCompare = GetParam().op;
    draw(state, counterClockwise(0.25f), 0.5f);
    EXPECT_EQ(drawn(), GetParam().whenNearer);
    EXPECT_EQ(depthInTheMiddle(), GetParam().whenNearer ? 0.25f : 0.5f);
    draw(state, counterClockwise(0.5f), 0.5f);
    EXPECT_EQ(drawn(), GetParam().whenEqual);
    draw(state, counterClockwise(0.75f), 0.5f);
    EXPECT_EQ(drawn(), GetParam().whenFarther);
    EXPECT_EQ(depthInTheMiddle(), GetParam().whenFarther ? 0.75f : 0.5f);
}

constexpr DepthCase kDepthCases[] = {
    {CompareOp::Never, false, false, false},      {CompareOp::Less, true, false, false},    {CompareOp::Equal, false, true, false},
    {CompareOp::LessEqual, true, true, false},    {CompareOp::Greater, false, false, true}, {CompareOp::NotEqual, true, false, true},
    {CompareOp::GreaterEqual, false, true, true}, {CompareOp::Always, true, true, true},
};

std::string caseName(const ::testing::TestParamInfo<DepthCase>& instance) {
    constexpr std::array kNames = {"Never", "Less", "Equal", "LessEqual", "Greater", "NotEqual", "GreaterEqual", "Always"};
    return kNames.at(static_cast<std::size_t>(instance.param.op));
}

INSTANTIATE_TEST_SUITE_P(Operators, DepthCompares, ::testing::ValuesIn(kDepthCases), caseName);

TEST_F(States, equal_against_a_depth_of_exactly_zero_passes_at_z_zero_and_nowhere_else) {
    // The culling of the texture-space passes: depth cleared to 0, drawn with EQUAL at z = 0.
    PipelineState state = plain();
    state.depthCompare = CompareOp::Equal;
    state.depthWrite = false;
    draw(state, counterClockwise(0.0f), 0.0f);
    EXPECT_TRUE(drawn());
    draw(state, counterClockwise(1e-30f), 0.0f);
    EXPECT_FALSE(drawn());
}

TEST_F(States, greater_against_zero_marks_what_the_next_equal_pass_must_skip) {
    PipelineState mark = plain();
    mark.depthCompare = CompareOp::Greater;
    mark.targets[0].writeMask = 0;
    draw(mark, counterClockwise(0.5f), 0.0f);
    EXPECT_FALSE(drawn());
    EXPECT_EQ(depthInTheMiddle(), 0.5f);
    PipelineState equal = plain();
    equal.depthCompare = CompareOp::Equal;
    drawMore(equal, counterClockwise(0.0f));
    EXPECT_FALSE(drawn());
}

TEST_F(States, depth_write_off_leaves_the_depth_alone) {
    PipelineState state = plain();
    state.depthWrite = false;
    draw(state, counterClockwise(0.25f));
    EXPECT_TRUE(drawn());
    EXPECT_EQ(depthInTheMiddle(), 1.0f);
}

TEST_F(States, depth_test_off_draws_regardless_and_writes_no_depth) {
    PipelineState state = plain();
    state.depthTest = false;
    state.depthCompare = CompareOp::Never;
    draw(state, counterClockwise(0.25f));
    EXPECT_TRUE(drawn());
    EXPECT_EQ(depthInTheMiddle(), 1.0f);
}

TEST_F(States, depth_bias_counts_steps_of_the_format) {
    PipelineState state = plain();
    state.depthBias = 16;
    draw(state, counterClockwise(0.75f));
    // A 32-bit float in [0.5, 1) has steps of 2^-24; Direct3D and Vulkan scale the bias by the step at the primitive's largest depth.
    EXPECT_EQ(depthInTheMiddle(), 0.75f + 16 * std::ldexp(1.0f, -24));
}

TEST_F(States, slope_scaled_bias_multiplies_the_largest_slope) {
    // z rises by 0.0625 from clip x -4 to 4, which is 32 pixels: a slope of 0.0625 / 32 for each pixel.
    std::array<Vertex, 3> tilted = {{{{-4, -8, 0.25f, 1}, kRed}, {{4, -8, 0.3125f, 1}, kRed}, {{0, 8, 0.28125f, 1}, kRed}}};
    draw(plain(), tilted);
    const float flat = depthInTheMiddle();
    PipelineState state = plain();
    state.slopeScaledDepthBias = 2;
    draw(state, tilted);
    EXPECT_NEAR(depthInTheMiddle() - flat, 2 * 0.0625 / 32, 1e-6); // a few float steps at 0.3
}

TEST_F(States, depth_clip_discards_what_lies_before_the_near_plane) {
    draw(plain(), counterClockwise(-0.25f));
    EXPECT_FALSE(drawn());
}

TEST_F(States, without_depth_clip_depth_is_clamped_instead) {
    PipelineState state = plain();
    state.depthClip = false;
    draw(state, counterClockwise(-0.25f));
    EXPECT_TRUE(drawn());
    EXPECT_EQ(depthInTheMiddle(), 0.0f);
}

TEST_F(States, wireframe_draws_edges_only) {
    PipelineState state = plain();
    state.fill = FillMode::Wireframe;
    const std::array<Vertex, 3> triangle = {
        {{{-0.875f, -0.875f, 0.5f, 1}, kRed}, {{0.875f, -0.875f, 0.5f, 1}, kRed}, {{0, 0.875f, 0.5f, 1}, kRed}}};
    draw(state, triangle);
    EXPECT_FALSE(drawn());
    const auto all = pixels(color_);
    EXPECT_EQ(all[7 * 8 + 4], kRed); // the bottom edge
}

TEST_F(States, write_masks_protect_channels) {
    PipelineState state = plain();
    state.targets[0].writeMask = 2 | 8; // green and alpha
    draw(state, counterClockwise(0.5f, {0.1f, 0.2f, 0.3f, 0.4f}));
    EXPECT_EQ(middle(), (Pixel{0, 0.2f, 0, 0.4f}));
}

class Blends : public States {
protected:
    /// Source (0.5, 0.25, 1, 0.5) over destination (0.25, 0.5, 0.75, 0.25).
    Pixel blended(const TargetBlend& blend, std::array<float, 4> constant = {1, 1, 1, 1}) {
        draw(plain(), counterClockwise(0.5f, {0.25f, 0.5f, 0.75f, 0.25f}));
        PipelineState state = plain();
        state.targets[0] = blend;
        state.targets[0].enable = true;
        state.blendConstant = constant;
        drawMore(state, counterClockwise(0.5f, {0.5f, 0.25f, 1.0f, 0.5f}));
        return middle();
    }
    Pixel factors(BlendFactor src, BlendFactor dst, std::array<float, 4> constant = {1, 1, 1, 1}) {
        return blended({.src = src, .dst = dst, .srcAlpha = src, .dstAlpha = dst}, constant);
    }
};

// All values are sums of few powers of two: blending in float is exact.
TEST_F(Blends, factors_weigh_source_and_destination) {
    using F = BlendFactor;
    EXPECT_EQ(factors(F::One, F::One), (Pixel{0.75f, 0.75f, 1.75f, 0.75f}));
    EXPECT_EQ(factors(F::SrcAlpha, F::InvSrcAlpha), (Pixel{0.375f, 0.375f, 0.875f, 0.375f}));
    EXPECT_EQ(factors(F::DestAlpha, F::InvDestAlpha), (Pixel{0.3125f, 0.4375f, 0.8125f, 0.3125f}));
    EXPECT_EQ(factors(F::DestColor, F::Zero), (Pixel{0.125f, 0.125f, 0.75f, 0.125f}));
    EXPECT_EQ(factors(F::InvDestColor, F::Zero), (Pixel{0.375f, 0.125f, 0.25f, 0.375f}));
    EXPECT_EQ(factors(F::Zero, F::SrcColor), (Pixel{0.125f, 0.125f, 0.75f, 0.125f}));
    EXPECT_EQ(factors(F::Zero, F::InvSrcColor), (Pixel{0.125f, 0.375f, 0, 0.125f}));
    EXPECT_EQ(factors(F::BlendFactor, F::Zero, {0.5f, 1, 0.25f, 2}), (Pixel{0.25f, 0.25f, 0.25f, 1.0f}));
    EXPECT_EQ(factors(F::InvBlendFactor, F::Zero, {0.5f, 1, 0.25f, 0}), (Pixel{0.25f, 0, 0.75f, 0.5f}));
    // min(source alpha, 1 - destination alpha) = 0.5; alpha itself gets factor 1.
    EXPECT_EQ(factors(F::SrcAlphaSat, F::Zero), (Pixel{0.25f, 0.125f, 0.5f, 0.5f}));
}

TEST_F(Blends, operators_combine_source_and_destination) {
    const auto with = [&](BlendOp op) { return blended({.dst = BlendFactor::One, .op = op, .dstAlpha = BlendFactor::One, .opAlpha = op}); };
    EXPECT_EQ(with(BlendOp::Add), (Pixel{0.75f, 0.75f, 1.75f, 0.75f}));
    EXPECT_EQ(with(BlendOp::Subtract), (Pixel{0.25f, -0.25f, 0.25f, 0.25f}));
    EXPECT_EQ(with(BlendOp::RevSubtract), (Pixel{-0.25f, 0.25f, -0.25f, -0.25f}));
    EXPECT_EQ(with(BlendOp::Min), (Pixel{0.25f, 0.25f, 0.75f, 0.25f}));
    EXPECT_EQ(with(BlendOp::Max), (Pixel{0.5f, 0.5f, 1.0f, 0.5f}));
}

TEST_F(Blends, alpha_has_factors_and_an_operator_of_its_own) {
    const Pixel result = blended({.src = BlendFactor::One,
                                  .dst = BlendFactor::Zero,
                                  .op = BlendOp::Add,
                                  .srcAlpha = BlendFactor::Zero,
                                  .dstAlpha = BlendFactor::One,
                                  .opAlpha = BlendOp::Add});
    EXPECT_EQ(result, (Pixel{0.5f, 0.25f, 1.0f, 0.25f}));
}

TEST_F(Blends, the_second_source_of_a_pixel_shader_is_a_factor) {
    Texture image = target(Format::RGBA32F, 1, 1);
    PipelineDesc desc = screen(dual_frag, {}, {Format::RGBA32F});
    desc.state.targets[0] = {
        .enable = true, .src = BlendFactor::Src1Color, .dst = BlendFactor::InvSrc1Color, .srcAlpha = BlendFactor::Src1Alpha};
    auto pipeline = device().createPipeline(desc);
    if (codeOf(pipeline) == 6024) GTEST_SKIP() << format(pipeline.error());
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.clearColor(image, {1, 1, 1, 1}));
        return recorder.draw({.colors = {&image}}, screenDraw(*pipeline));
    }));
    EXPECT_EQ(pixels(image).front(), (Pixel{0.875f, 0.875f, 0.875f, 0.125f})); // 0.5 * 0.25 + 1 * 0.75
}

TEST_F(Blends, targets_may_blend_differently) {
    Texture images[2] = {target(Format::RGBA32F, 1, 1), target(Format::RGBA32F, 1, 1)};
    PipelineDesc desc = screen(dual_frag, {}, {Format::RGBA32F, Format::RGBA32F});
    desc.pixel = {.spirv = uniform_frag, .entry = "main"};
    desc.bindings = {{0, 0}};
    desc.state.targets[0] = {.enable = true, .src = BlendFactor::One, .dst = BlendFactor::One, .dstAlpha = BlendFactor::One};
    desc.state.targets[1].writeMask = 0;
    const Pipeline pipeline = must(device().createPipeline(desc));
    const Pixel color = {1, 2, 3, 4};
    must(device().run([&](Recorder& recorder) -> Result<void> {
        for (Texture& image : images)
            must(recorder.clearColor(image, {1, 1, 1, 1}));
        return recorder.draw({.colors = {&images[0], &images[1]}}, screenDraw(pipeline, {{0, 0, bytesOf(color)}}));
    }));
    EXPECT_EQ(pixels(images[0]).front(), (Pixel{2, 3, 4, 5}));
    EXPECT_EQ(pixels(images[1]).front(), (Pixel{1, 1, 1, 1}));
}

class Stencils : public States {
protected:
    /// Clears stencil to `before`, runs `op` as the pass operation everywhere, then counts on Equal with `expected`.
    bool becomes(std::uint32_t before, StencilOp op, std::uint32_t reference, std::uint32_t expected) {
        clear(1.0f, Format::D24S8);
        must(device().run([&](Recorder& recorder) { return recorder.clearDepthStencil(depth_, std::nullopt, before); }));
        PipelineState write = plain();
        write.stencilTest = true;
        write.stencilFront = write.stencilBack = {.pass = op};
        write.stencilReference = reference;
        drawMore(write, counterClockwise(0.5f, {0, 0, 0, 0}));
        PipelineState test = plain();
        test.stencilTest = true;
        test.stencilFront = test.stencilBack = {.compare = CompareOp::Equal};
        test.stencilReference = expected;
        drawMore(test, counterClockwise(0.25f, kGreen));
        return drawn();
    }
};

TEST_F(Stencils, operations_change_the_stencil_value) {
    EXPECT_TRUE(becomes(5, StencilOp::Keep, 9, 5));
    EXPECT_TRUE(becomes(5, StencilOp::Zero, 9, 0));
    EXPECT_TRUE(becomes(5, StencilOp::Replace, 9, 9));
    EXPECT_TRUE(becomes(255, StencilOp::IncrSat, 9, 255));
    EXPECT_TRUE(becomes(0, StencilOp::DecrSat, 9, 0));
    EXPECT_TRUE(becomes(0x0f, StencilOp::Invert, 9, 0xf0));
    EXPECT_TRUE(becomes(255, StencilOp::Incr, 9, 0));
    EXPECT_TRUE(becomes(0, StencilOp::Decr, 9, 255));
}

TEST_F(Stencils, a_failing_compare_draws_nothing) {
    EXPECT_FALSE(becomes(5, StencilOp::Keep, 9, 6));
}

TEST_F(Stencils, clearing_depth_alone_keeps_the_stencil) {
    clear(1.0f, Format::D24S8);
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.clearDepthStencil(depth_, std::nullopt, 7));
        return recorder.clearDepthStencil(depth_, 0.5f, std::nullopt);
    }));
    must(device().run([&](Recorder& recorder) { return recorder.clearDepthStencil(depth_, 1.0f, std::nullopt); }));
    PipelineState test = plain();
    test.stencilTest = true;
    test.stencilFront = test.stencilBack = {.compare = CompareOp::Equal};
    test.stencilReference = 7;
    drawMore(test, counterClockwise());
    EXPECT_TRUE(drawn());
}

} // namespace
} // namespace tegument::gpu
