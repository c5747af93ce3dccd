// Samplers, cube maps and sampled depth.

#include "tests/gpu/fixture.h"

#include "shaders/compare_frag.h"
#include "shaders/cube_frag.h"
#include "shaders/sample_frag.h"

namespace tegument::gpu {
namespace {

struct Place {
    float u, v, lod, unused;
};

class Samplers : public Gpu {
protected:
    /// What the sampler reads at (u, v) of the texture.
    Pixel at(Texture& image, const SamplerState& state, float u, float v, float lod = 0) {
        const Sampler made = must(device().createSampler(state));
        Texture out = target(Format::RGBA32F, 1, 1);
        const std::vector<Binding> bindings = {
            {0, 0, BindingKind::UniformBuffer}, {0, 1, BindingKind::Texture}, {0, 2, BindingKind::Sampler}};
        const Pipeline pipeline = must(device().createPipeline(screen(sample_frag, bindings, {Format::RGBA32F})));
        const Place place{u, v, lod, 0};
        must(drawOnce({.colors = {&out}}, screenDraw(pipeline, {{0, 0, objectBytes(place)}, {0, 1, &image}, {0, 2, &made}})));
        return pixels(out).front();
    }

    /// 4 x 1 texels with red 0, 1, 2, 3.
    Texture row() { return texture(4, 1, {{0, 0, 0, 0}, {1, 0, 0, 0}, {2, 0, 0, 0}, {3, 0, 0, 0}}); }
};

SamplerState with(Filter filter, Address address) {
    return {.minFilter = filter,
            .magFilter = filter,
            .mipFilter = filter,
            .addressU = address,
            .addressV = address,
            .addressW = address,
            .compare = {}};
}

TEST_F(Samplers, point_reads_the_texel_that_holds_the_place) {
    Texture image = row();
    EXPECT_EQ(at(image, with(Filter::Point, Address::Clamp), 0.24f, 0.5f)[0], 0);
    EXPECT_EQ(at(image, with(Filter::Point, Address::Clamp), 0.26f, 0.5f)[0], 1);
}

TEST_F(Samplers, linear_weighs_the_two_nearest_centres) {
    Texture image = row();
    EXPECT_EQ(at(image, with(Filter::Linear, Address::Clamp), 0.125f, 0.5f)[0], 0);
    EXPECT_EQ(at(image, with(Filter::Linear, Address::Clamp), 0.25f, 0.5f)[0], 0.5f); // halfway; weights have at least 4 fraction bits
}

TEST_F(Samplers, addresses_beyond_the_edge) {
    Texture image = row();
    const auto red = [&](Address address, float u) { return at(image, with(Filter::Point, address), u, 0.5f)[0]; };
    EXPECT_EQ(red(Address::Wrap, 1.125f), 0);
    EXPECT_EQ(red(Address::Wrap, -0.125f), 3);
    EXPECT_EQ(red(Address::Mirror, 1.125f), 3);
    EXPECT_EQ(red(Address::Mirror, 1.375f), 2);
    EXPECT_EQ(red(Address::Mirror, -0.375f), 1);
    EXPECT_EQ(red(Address::Clamp, 7.0f), 3);
    EXPECT_EQ(red(Address::Clamp, -7.0f), 0);
    EXPECT_EQ(red(Address::MirrorOnce, -0.375f), 1);
    EXPECT_EQ(red(Address::MirrorOnce, -7.0f), 3);
}

TEST_F(Samplers, border_colours_are_read_outside) {
    Texture image = row();
    SamplerState state = with(Filter::Point, Address::Border);
    for (const Pixel color : {Pixel{0, 0, 0, 0}, Pixel{0, 0, 0, 1}, Pixel{1, 1, 1, 1}}) {
        state.borderColor = color;
        EXPECT_EQ(at(image, state, 1.5f, 0.5f), color);
    }
}

TEST_F(Samplers, any_border_colour_is_read_outside_or_refused) {
    SamplerState state = with(Filter::Point, Address::Border);
    state.borderColor = {0.25f, 0.5f, 0.75f, 1};
    const auto made = device().createSampler(state);
    if (!made) {
        EXPECT_EQ(codeOf(made), 6050);
        GTEST_SKIP() << format(made.error());
    }
    Texture image = row();
    EXPECT_EQ(at(image, state, 1.5f, 0.5f), state.borderColor);
}

/// Level 0 is 0, level 1 is 1, level 2 is 2.
class Mipmapped : public Samplers {
protected:
    Texture levels() {
        Texture image = must(device().createTexture({.name = "levels", .format = Format::RGBA32F, .width = 4, .height = 4, .mips = 0}));
        for (std::uint32_t mip = 0; mip < 3; ++mip) {
            const auto value = static_cast<float>(mip);
            const std::size_t side = 4u >> mip;
            must(device().upload(image, bytesOf(std::vector<Pixel>(side * side, {value, value, value, value})), mip));
        }
        return image;
    }
};

TEST_F(Mipmapped, linear_mip_filter_mixes_levels_and_point_takes_the_nearest) {
    Texture image = levels();
    EXPECT_EQ(at(image, with(Filter::Linear, Address::Wrap), 0.5f, 0.5f, 1.5f)[0], 1.5f);
    SamplerState state = with(Filter::Linear, Address::Wrap);
    state.mipFilter = Filter::Point;
    EXPECT_EQ(at(image, state, 0.5f, 0.5f, 1.25f)[0], 1);
    EXPECT_EQ(at(image, state, 0.5f, 0.5f, 1.75f)[0], 2);
}

TEST_F(Mipmapped, without_mipmapping_only_the_first_level_is_read) {
    Texture image = levels();
    SamplerState state = with(Filter::Linear, Address::Wrap);
    state.mipmapping = false;
    EXPECT_EQ(at(image, state, 0.5f, 0.5f, 2)[0], 0);
}

TEST_F(Mipmapped, without_mipmapping_the_minification_filter_still_works) {
    Texture image = row();
    SamplerState state = with(Filter::Linear, Address::Clamp);
    state.mipmapping = false;
    state.magFilter = Filter::Point;
    EXPECT_EQ(at(image, state, 0.25f, 0.5f, 1)[0], 0.5f); // minified: linear
    EXPECT_EQ(at(image, state, 0.26f, 0.5f, 0)[0], 1);    // magnified: point
}

TEST_F(Mipmapped, lod_limits_and_bias_move_the_level) {
    Texture image = levels();
    SamplerState state = with(Filter::Linear, Address::Wrap);
    state.minLod = 1;
    EXPECT_EQ(at(image, state, 0.5f, 0.5f, 0)[0], 1);
    state.minLod = 0;
    state.maxLod = 1;
    EXPECT_EQ(at(image, state, 0.5f, 0.5f, 2)[0], 1);
    state.maxLod = 1000;
    state.mipLodBias = 1;
    EXPECT_EQ(at(image, state, 0.5f, 0.5f, 0.5f)[0], 1.5f);
}

TEST_F(Samplers, anisotropic_filters_are_accepted_at_any_count) {
    Texture image = row();
    SamplerState state = with(Filter::Anisotropic, Address::Clamp);
    for (const int count : {0, 1, 4, 1000}) {
        state.maxAnisotropy = count;
        EXPECT_EQ(at(image, state, 0.25f, 0.5f)[0], 0.5f);
    }
}

TEST_F(Samplers, a_cube_map_has_its_faces_in_direct3ds_order_and_orientation) {
    // Face f is f everywhere but for its top left texel, 10 + f.
    Texture cube = must(device().createTexture({.name = "cube", .format = Format::RGBA32F, .width = 4, .height = 4, .cube = true}));
    for (std::uint32_t face = 0; face < 6; ++face) {
        const auto value = static_cast<float>(face);
        std::vector<Pixel> texels(16, {value, value, value, 1});
        texels[0][0] = 10 + value;
        must(device().upload(cube, bytesOf(texels), 0, face));
    }
    const Sampler point = sampler(Filter::Point, Address::Clamp);
    const std::vector<Binding> bindings = {{0, 0, BindingKind::UniformBuffer}, {0, 1, BindingKind::Texture}, {0, 2, BindingKind::Sampler}};
    const Pipeline pipeline = must(device().createPipeline(screen(cube_frag, bindings, {Format::RGBA32F})));
    Texture out = target(Format::RGBA32F, 1, 1);
    const auto towards = [&](Pixel direction) {
        must(drawOnce({.colors = {&out}}, screenDraw(pipeline, {{0, 0, bytesOf(direction)}, {0, 1, &cube}, {0, 2, &point}})));
        return pixels(out).front()[0];
    };
    // Direct3D's table of face axes (u, v): +X (-z, -y), -X (+z, -y), +Y (+x, +z), -Y (+x, -z), +Z (+x, -y), -Z (-x, -y).
    const std::array<Pixel, 6> centres = {
        {{1, 0.1f, 0.1f, 0}, {-1, 0.1f, 0.1f, 0}, {0.1f, 1, 0.1f, 0}, {0.1f, -1, 0.1f, 0}, {0.1f, 0.1f, 1, 0}, {0.1f, 0.1f, -1, 0}}};
    const std::array<Pixel, 6> topLefts = {
        {{1, 0.9f, 0.9f, 0}, {-1, 0.9f, -0.9f, 0}, {-0.9f, 1, -0.9f, 0}, {-0.9f, -1, 0.9f, 0}, {-0.9f, 0.9f, 1, 0}, {0.9f, 0.9f, -1, 0}}};
    for (std::size_t face = 0; face < 6; ++face) {
        EXPECT_EQ(towards(centres[face]), static_cast<float>(face));
        EXPECT_EQ(towards(topLefts[face]), static_cast<float>(10 + face));
    }
}

TEST_F(Samplers, a_depth_target_is_compared_when_it_is_sampled) {
    Texture depth = target(Format::D32F, 2, 2);
    Texture out = target(Format::RGBA32F, 2, 2);
    SamplerState state = with(Filter::Point, Address::Clamp);
    state.compare = CompareOp::LessEqual;
    const Sampler comparing = must(device().createSampler(state));
    const std::vector<Binding> bindings = {{0, 0, BindingKind::UniformBuffer}, {0, 1, BindingKind::Texture}, {0, 2, BindingKind::Sampler}};
    const Pipeline pipeline = must(device().createPipeline(screen(compare_frag, bindings, {Format::RGBA32F})));
    for (const float reference : {0.25f, 0.5f, 0.75f}) {
        const Pixel block = {reference, 0, 0, 0};
        must(device().run([&](Recorder& recorder) -> Result<void> {
            must(recorder.clearDepthStencil(depth, 0.5f, std::nullopt));
            return recorder.draw({.colors = {&out}}, screenDraw(pipeline, {{0, 0, bytesOf(block)}, {0, 1, &depth}, {0, 2, &comparing}}));
        }));
        EXPECT_EQ(pixels(out).front()[0], reference <= 0.5f ? 1.0f : 0.0f);
    }
}

} // namespace
} // namespace tegument::gpu
