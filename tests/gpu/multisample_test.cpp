// Multisampled targets: what a triangle's edge, depth and blending do sample by sample, and what the resolve makes of them.

#include "tests/gpu/fixture.h"

#include "shaders/color_frag.h"
#include "shaders/copy_frag.h"
#include "shaders/mesh_vert.h"

#include <algorithm>
#include <cmath>

namespace tegument::gpu {
namespace {

constexpr std::uint32_t kSide = 16;
constexpr double kSlope = 0.1;   // of the edge, rows per column
constexpr double kHeight = 7.32; // rows below the top at which it begins

struct SampledVertex {
    Pixel position;
    Pixel color;
};

float clipY(double row) {
    return static_cast<float>(1 - 2 * row / kSide);
}

/// Everything below the edge, at this depth.
std::array<SampledVertex, 3> below(float z, Pixel color) {
    // Columns -16 and 32 are clip x -3 and 3; the third corner is far enough down for the triangle to hold the rest.
    return {
        {{{-3, clipY(kHeight - 16 * kSlope), z, 1}, color}, {{3, clipY(kHeight + 32 * kSlope), z, 1}, color}, {{0, -200, z, 1}, color}}};
}

std::array<SampledVertex, 3> everywhere(float z, Pixel color) {
    return {{{{-4, -4, z, 1}, color}, {{4, -4, z, 1}, color}, {{0, 8, z, 1}, color}}};
}

/// Share of the pixel that lies below the edge: the mean over its width of a height clamped to the pixel, by 1,024 strips.
double exactCoverage(std::uint32_t x, std::uint32_t y) {
    constexpr int kStrips = 1024;
    double sum = 0;
    for (int i = 0; i < kStrips; ++i) {
        const double edge = kHeight + kSlope * (x + (i + 0.5) / kStrips);
        sum += std::clamp(y + 1 - edge, 0.0, 1.0);
    }
    return sum / kStrips;
}

/// Each test is done with every number of samples that the device offers; 4 is among them on all.
class Multisampling : public Gpu {
protected:
    template <class Body>
    void withEachCount(Body body) {
        for (const std::uint32_t samples : {2u, 4u, 8u}) {
            samples_ = samples;
            auto made = device().createTexture(describe(Format::RGBA32F));
            if (samples != 4 && codeOf(made) == 6016) continue;
            SCOPED_TRACE(std::to_string(samples) + " samples");
            color_ = must(std::move(made));
            depth_ = must(device().createTexture(describe(Format::D32F)));
            picture_ = target(Format::RGBA32F, kSide, kSide);
            body();
        }
    }

    [[nodiscard]] TextureDesc describe(Format format) const {
        return {.name = "samples", .format = format, .width = kSide, .height = kSide, .renderTarget = true, .samples = samples_};
    }

    Pipeline pipeline(const PipelineState& state) {
        PipelineDesc desc = screen(color_frag, {}, {Format::RGBA32F});
        desc.vertex = {.spirv = mesh_vert, .entry = "main"};
        desc.attributes = {{.location = 0, .components = 4, .offset = 0}, {.location = 1, .components = 4, .offset = 16}};
        desc.vertexStride = sizeof(SampledVertex);
        desc.depthFormat = Format::D32F;
        desc.samples = samples_;
        desc.state = state;
        desc.state.cull = CullMode::None;
        return must(device().createPipeline(desc));
    }

    /// One after the other, each with its state, into cleared targets; then the picture.
    std::vector<Pixel> drawn(std::initializer_list<std::pair<std::array<SampledVertex, 3>, PipelineState>> triangles) {
        std::vector<Buffer> buffers;
        std::vector<Pipeline> pipelines;
        for (const auto& triangle : triangles) {
            buffers.push_back(must(device().createBuffer(BufferUsage::Vertex, bytesOf(triangle.first))));
            pipelines.push_back(pipeline(triangle.second));
        }
        must(device().run([&](Recorder& recorder) -> Result<void> {
            must(recorder.clearColor(color_, {0, 0, 0, 0}));
            must(recorder.clearDepthStencil(depth_, 1.0f, std::nullopt));
            for (std::size_t i = 0; i < buffers.size(); ++i)
                must(recorder.draw({.colors = {&color_}, .depth = &depth_},
                                   {.pipeline = &pipelines[i], .vertices = &buffers[i], .count = 3}));
            return recorder.resolve(color_, picture_);
        }));
        return pixels(picture_);
    }

    std::uint32_t samples_ = 1;
    Texture color_;
    Texture depth_;
    Texture picture_;
};

TEST_F(Multisampling, a_slanted_edge_covers_its_area_within_one_sample) {
    withEachCount([this] {
        const auto picture = drawn({{below(0.5f, kRed), {}}});
        for (std::uint32_t y = 0; y < kSide; ++y)
            for (std::uint32_t x = 0; x < kSide; ++x)
                EXPECT_NEAR(picture[y * kSide + x][0], exactCoverage(x, y), 1.0 / samples_) << x << ", " << y;
    });
}

TEST_F(Multisampling, coverage_comes_in_steps_of_one_sample) {
    withEachCount([this] {
        const auto picture = drawn({{below(0.5f, kRed), {}}});
        bool partly = false;
        for (const Pixel& pixel : picture) {
            const float samples = pixel[0] * static_cast<float>(samples_);
            EXPECT_EQ(samples, std::round(samples));
            partly = partly || (pixel[0] > 0 && pixel[0] < 1);
        }
        EXPECT_TRUE(partly);
    });
}

TEST_F(Multisampling, depth_is_tested_sample_by_sample) {
    withEachCount([this] {
        const auto alone = drawn({{below(0.25f, kRed), {}}});
        const auto behind = drawn({{below(0.25f, kRed), {}}, {everywhere(0.75f, kGreen), {}}});
        for (std::size_t i = 0; i < alone.size(); ++i) {
            EXPECT_EQ(behind[i][0], alone[i][0]) << i;
            EXPECT_EQ(behind[i][1], 1 - alone[i][0]) << i;
        }
    });
}

TEST_F(Multisampling, blending_happens_sample_by_sample) {
    withEachCount([this] {
        // Colour times its own alpha leaves samples of 0 and 1 what they are; done to a resolved pixel it would square the coverage.
        PipelineState square;
        square.depthTest = false;
        square.targets[0] = {.enable = true, .src = BlendFactor::Zero, .dst = BlendFactor::DestAlpha, .srcAlpha = BlendFactor::Zero};
        const auto alone = drawn({{below(0.5f, kRed), {}}});
        const auto blended = drawn({{below(0.5f, kRed), {}}, {everywhere(0.25f, kGreen), square}});
        for (std::size_t i = 0; i < alone.size(); ++i)
            EXPECT_EQ(blended[i][0], alone[i][0]) << i;
    });
}

TEST_F(Multisampling, a_clear_reaches_every_sample) {
    withEachCount([this] {
        must(device().run([&](Recorder& recorder) -> Result<void> {
            must(recorder.clearColor(color_, {0.25f, 0.5f, 2, 1}));
            return recorder.resolve(color_, picture_);
        }));
        for (const Pixel& pixel : pixels(picture_))
            EXPECT_EQ(pixel, (Pixel{0.25f, 0.5f, 2, 1}));
    });
}

TEST_F(Multisampling, new_targets_hold_zeros) {
    withEachCount([this] {
        must(device().run([&](Recorder& recorder) { return recorder.resolve(color_, picture_); }));
        for (const Pixel& pixel : pixels(picture_))
            EXPECT_EQ(pixel, (Pixel{0, 0, 0, 0}));
    });
}

TEST_F(Multisampling, a_target_counts_the_bytes_of_every_sample) {
    withEachCount([this] { EXPECT_EQ(color_.bytes(), std::uint64_t{kSide} * kSide * 16 * samples_); });
}

TEST_F(Multisampling, a_resolved_target_can_be_drawn_to_again) {
    withEachCount([this] {
        // The frame after the first loads what is there: nothing may be lost between drawing, resolving and drawing.
        static_cast<void>(drawn({{below(0.5f, kRed), {}}}));
        const Pipeline more = pipeline({});
        const auto triangle = everywhere(0.75f, kGreen);
        const Buffer buffer = must(device().createBuffer(BufferUsage::Vertex, bytesOf(triangle)));
        must(device().run([&](Recorder& recorder) -> Result<void> {
            must(recorder.draw({.colors = {&color_}, .depth = &depth_}, {.pipeline = &more, .vertices = &buffer, .count = 3}));
            return recorder.resolve(color_, picture_);
        }));
        for (const Pixel& pixel : pixels(picture_))
            EXPECT_EQ(pixel[0] + pixel[1], 1.0f);
    });
}

/// What cannot be done with several samples. Every device has 4.
class SampleMistakes : public Gpu {
protected:
    [[nodiscard]] static TextureDesc describe(std::uint32_t samples, Format format = Format::RGBA32F) {
        return {.name = "culprit", .format = format, .width = 8, .height = 8, .renderTarget = true, .samples = samples};
    }

    template <class T>
    static void expectFailure(const Result<T>& result, int code, std::initializer_list<std::string_view> words) {
        ASSERT_EQ(codeOf(result), code);
        const std::string text = format(result.error());
        for (const std::string_view word : words)
            EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is missing: " << text;
    }
};

TEST_F(SampleMistakes, a_count_that_the_device_does_not_offer_is_refused_with_those_that_it_does) {
    for (const std::uint32_t samples : {0u, 3u, 256u})
        expectFailure(device().createTexture(describe(samples)), 6016, {"culprit", device().info().name, "1, "});
}

TEST_F(SampleMistakes, pipelines_too_are_refused_such_a_count) {
    PipelineDesc desc = screen(copy_frag, {{0, 1, BindingKind::Texture}, {0, 2, BindingKind::Sampler}}, {Format::RGBA32F});
    desc.samples = 3;
    expectFailure(device().createPipeline(desc), 6016, {"screen", "3", "1, "});
}

TEST_F(SampleMistakes, only_a_render_target_of_one_level_has_samples) {
    TextureDesc image = describe(4);
    image.renderTarget = false;
    expectFailure(device().createTexture(image), 6012, {"culprit"});
    TextureDesc chain = describe(4);
    chain.mips = 0;
    expectFailure(device().createTexture(chain), 6012, {"culprit"});
}

TEST_F(SampleMistakes, a_multisampled_texture_cannot_be_copied_or_sampled) {
    Texture samples = must(device().createTexture(describe(4)));
    expectFailure(device().readback(samples), 6017, {"culprit"});
    const std::vector<Pixel> texels(64);
    expectFailure(device().upload(samples, bytesOf(texels)), 6017, {"culprit"});
    Texture picture = target(Format::RGBA32F, 8, 8);
    const Sampler point = sampler(Filter::Point, Address::Clamp);
    const Pipeline copy = reading(copy_frag);
    expectFailure(drawOnce({.colors = {&picture}}, screenDraw(copy, {{0, 1, &samples}, {0, 2, &point}})), 6017, {"screen"});
}

TEST_F(SampleMistakes, a_pipeline_draws_to_targets_of_its_own_count) {
    Texture samples = must(device().createTexture(describe(4)));
    Texture image = texture(1, 1, {kRed});
    const Sampler point = sampler(Filter::Point, Address::Clamp);
    const Pipeline copy = reading(copy_frag);
    expectFailure(drawOnce({.colors = {&samples}}, screenDraw(copy, {{0, 1, &image}, {0, 2, &point}})), 6035, {"culprit", "4", "1"});
}

TEST_F(SampleMistakes, only_like_textures_of_colour_are_resolved) {
    Texture four = must(device().createTexture(describe(4)));
    Texture depth = must(device().createTexture(describe(4, Format::D32F)));
    Texture one = target(Format::RGBA32F, 8, 8);
    Texture small = target(Format::RGBA32F, 4, 8);
    Texture bytes = target(Format::RGBA8, 8, 8);
    Texture oneDepth = target(Format::D32F, 8, 8);
    const auto resolve = [this](Texture& from, Texture& to) {
        return device().run([&](Recorder& recorder) { return recorder.resolve(from, to); });
    };
    for (Texture* to : {&small, &bytes, &four})
        expectFailure(resolve(four, *to), 6044, {"culprit"});
    expectFailure(resolve(one, one), 6044, {"target"});
    expectFailure(resolve(depth, oneDepth), 6044, {"D32F"});
}

} // namespace
} // namespace tegument::gpu
