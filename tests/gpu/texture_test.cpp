// Textures: what clears, uploads and mip chains leave in them.
// Samplers, cube maps and sampled depth.

#include "host/gpu/part.h"
#include "shaders/compare_frag.h"
#include "shaders/copy_frag.h"
#include "shaders/cube_frag.h"
#include "shaders/sample_frag.h"
#include "tests/gpu/fixture.h"

#include <cmath>
#include <numeric>

namespace tegument::gpu {
namespace {

struct ClearCase {
    Format format;
    std::uint32_t bitsPerChannel;
    std::vector<double> channels; // of one texel, as integers or halves' bits or floats, in memory order
    double tolerance;             // unorm: Vulkan lets a tie go either way; halves: llvmpipe truncates
};

// The clear colour is (0.2, 0.4, 0.6, 0.8): 51, 102, 153, 204 of 255 and 13107 times 1 to 4 of 65535. sRGB: 12.92 c below 0.0031308,
// 1.055 c^(1/2.4) - 0.055 above: 0.2 -> 0.48453, 0.4 -> 0.66519, 0.6 -> 0.79774. Halves: 0x3266 = 0.19995, 0x3666 = 0.39990,
// 0x38cd = 0.60010, 0x3a66 = 0.79980.
const ClearCase kCases[] = {
    {Format::R8, 8, {51}, 1},
    {Format::RG8, 8, {51, 102}, 1},
    {Format::RGBA8, 8, {51, 102, 153, 204}, 1},
    {Format::BGRA8, 8, {153, 102, 51, 204}, 1},
    {Format::RGBA8Srgb, 8, {123.56, 169.62, 203.42, 204}, 1},
    {Format::RGBA16, 16, {13107, 26214, 39321, 52428}, 1},
    {Format::R16F, 16, {0x3266}, 1},
    {Format::RG16F, 16, {0x3266, 0x3666}, 1},
    {Format::RGBA16F, 16, {0x3266, 0x3666, 0x38cd, 0x3a66}, 1},
    {Format::R32F, 32, {0.2f}, 0},
    {Format::RG32F, 32, {0.2f, 0.4f}, 0},
    {Format::RGBA32F, 32, {0.2f, 0.4f, 0.6f, 0.8f}, 0},
};

std::vector<double> channels(std::span<const std::byte> bytes, std::uint32_t bits) {
    const auto widen = [](const auto& values) { return std::vector<double>(values.begin(), values.end()); };
    if (bits == 8) return widen(fromBytes<std::uint8_t>(bytes));
    if (bits == 16) return widen(fromBytes<std::uint16_t>(bytes));
    return widen(fromBytes<float>(bytes));
}

class ClearedColor : public Gpu, public ::testing::WithParamInterface<ClearCase> {};

TEST_P(ClearedColor, reads_back_in_every_texel) {
    const ClearCase& expected = GetParam();
    Texture image = target(expected.format, 3, 2);
    must(device().run([&](Recorder& recorder) { return recorder.clearColor(image, {0.2f, 0.4f, 0.6f, 0.8f}); }));
    const auto all = channels(must(device().readback(image)), expected.bitsPerChannel);
    ASSERT_EQ(all.size(), 6 * expected.channels.size());
    EXPECT_EQ(all.size() * expected.bitsPerChannel / 8, 6 * bytesPerPixel(expected.format));
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_NEAR(all[i], expected.channels[i % expected.channels.size()], expected.tolerance) << "channel " << i;
}

INSTANTIATE_TEST_SUITE_P(Formats, ClearedColor, ::testing::ValuesIn(kCases),
                         [](const auto& instance) { return std::string(name(instance.param.format)); });

class ClearedDepth : public Gpu, public ::testing::WithParamInterface<Format> {};

TEST_P(ClearedDepth, reads_back_as_floats) {
    Texture image = target(GetParam(), 3, 2);
    must(device().run([&](Recorder& recorder) { return recorder.clearDepthStencil(image, 0.25f, std::nullopt); }));
    const auto depths = floats(image);
    ASSERT_EQ(depths.size(), 6u);
    for (const float depth : depths)
        EXPECT_NEAR(depth, 0.25f, 1.0 / 65535); // one step of 16 bits
}

INSTANTIATE_TEST_SUITE_P(Formats, ClearedDepth, ::testing::Values(Format::D16, Format::D24S8, Format::D32F, Format::D32FS8),
                         [](const auto& instance) { return std::string(name(instance.param)); });

class Textures : public Gpu {};

TEST_F(Textures, some_texels_are_read_back_as_all_of_them_are) {
    Texture image = must(device().createTexture({.name = "parts", .format = Format::R32F, .width = 8, .height = 4, .mips = 2}));
    std::vector<float> values(8 * 4);
    std::iota(values.begin(), values.end(), 0.0F);
    must(device().upload(image, std::as_bytes(std::span(values))));
    must(device().upload(image, std::as_bytes(std::span(values).first(4 * 2)), 1));
    EXPECT_EQ(fromBytes<float>(must(readbackPart(image, {.x = 5, .y = 1, .width = 2, .height = 2}))), (std::vector<float>{13, 14, 21, 22}));
    EXPECT_EQ(fromBytes<float>(must(readbackPart(image, {.x = 3, .y = 1}, 1))), std::vector<float>{7});
    for (const TexelRect& outside : {TexelRect{.x = 8}, TexelRect{.y = 4}, TexelRect{.x = 7, .width = 2}, TexelRect{.width = 0}}) {
        const auto none = readbackPart(image, outside);
        ASSERT_FALSE(none);
        EXPECT_EQ(none.error().diagnostics.front().code, 6014);
    }
}

TEST_F(Textures, packed_10_bit_colour_has_red_in_the_low_bits) {
    Texture image = target(Format::RGB10A2, 1, 1);
    must(device().run([&](Recorder& recorder) { return recorder.clearColor(image, {1, 0, 1, 0}); }));
    EXPECT_EQ(fromBytes<std::uint32_t>(must(device().readback(image))).front(), 1023u | 1023u << 20);
}

TEST_F(Textures, a_new_texture_is_zero_in_every_level) {
    Texture image = must(device().createTexture({.name = "new", .format = Format::R32F, .width = 4, .height = 4, .mips = 0}));
    for (std::uint32_t mip = 0; mip < 3; ++mip)
        for (const float value : fromBytes<float>(must(device().readback(image, mip))))
            EXPECT_EQ(value, 0.0f);
}

TEST_F(Textures, what_is_uploaded_to_each_level_and_face_reads_back) {
    Texture cube = must(device().createTexture({.name = "cube", .format = Format::R32F, .width = 2, .height = 2, .mips = 2, .cube = true}));
    const auto value = [](std::uint32_t mip, std::uint32_t face) { return static_cast<float>(10 * mip + face); };
    for (std::uint32_t face = 0; face < 6; ++face)
        for (std::uint32_t mip = 0; mip < 2; ++mip)
            must(device().upload(cube, bytesOf(std::vector<float>(mip == 0 ? 4 : 1, value(mip, face))), mip, face));
    for (std::uint32_t face = 0; face < 6; ++face)
        for (std::uint32_t mip = 0; mip < 2; ++mip)
            EXPECT_EQ(fromBytes<float>(must(device().readback(cube, mip, face))), std::vector<float>(mip == 0 ? 4 : 1, value(mip, face)));
}

TEST_F(Textures, depths_that_are_uploaded_read_back) {
    for (const bool cube : {false, true}) {
        Texture depth = must(device().createTexture({.name = "depth", .format = Format::D32F, .width = 2, .height = 2, .cube = cube}));
        for (std::uint32_t face = 0; face < (cube ? 6U : 1U); ++face) {
            const std::vector<float> depths = {0, 0.1F * static_cast<float>(face), 0.7F, 1};
            must(device().upload(depth, bytesOf(depths), 0, face));
            EXPECT_EQ(fromBytes<float>(must(device().readback(depth, 0, face))), depths);
        }
    }
}

TEST_F(Textures, rows_are_tightly_packed_whatever_the_width) {
    std::vector<std::uint8_t> bytes(5 * 3);
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::uint8_t>(i);
    Texture image = must(device().createTexture({.name = "odd", .format = Format::R8, .width = 5, .height = 3}));
    must(device().upload(image, bytesOf(bytes)));
    EXPECT_EQ(fromBytes<std::uint8_t>(must(device().readback(image))), bytes);
}

TEST_F(Textures, zero_mips_ask_for_the_full_chain) {
    EXPECT_EQ(must(device().createTexture({.name = "chain", .width = 5, .height = 9, .mips = 0})).desc().mips, 4u); // 9 4 2 1
}

TEST_F(Textures, a_mip_level_is_the_mean_of_the_texels_below) {
    std::vector<Pixel> texels;
    for (int i = 0; i < 16; ++i)
        texels.push_back({static_cast<float>(i), static_cast<float>(i * i), 1, static_cast<float>(i % 4)});
    Texture image = must(device().createTexture({.name = "mips", .format = Format::RGBA32F, .width = 4, .height = 4, .mips = 0}));
    must(device().upload(image, bytesOf(texels)));
    must(device().run([&](Recorder& recorder) { return recorder.generateMips(image); }));
    // Texels 0 1 4 5: means 2.5, 42/4 and 0.5. The filter's weights are 1/2, the sums small integers: exact.
    EXPECT_EQ(pixels(image, 1).front(), (Pixel{2.5f, 10.5f, 1, 0.5f}));
    EXPECT_EQ(pixels(image, 2).front(), (Pixel{7.5f, 77.5f, 1, 1.5f}));
}

TEST_F(Textures, mips_of_a_cube_map_do_not_mix_its_faces) {
    Texture cube = must(device().createTexture({.name = "cube", .format = Format::R32F, .width = 4, .height = 4, .mips = 0, .cube = true}));
    for (std::uint32_t face = 0; face < 6; ++face)
        must(device().upload(cube, bytesOf(std::vector<float>(16, static_cast<float>(face))), 0, face));
    must(device().run([&](Recorder& recorder) { return recorder.generateMips(cube); }));
    for (std::uint32_t face = 0; face < 6; ++face)
        EXPECT_EQ(fromBytes<float>(must(device().readback(cube, 2, face))).front(), static_cast<float>(face));
}

TEST_F(Textures, srgb_mips_are_means_of_linear_light) {
    Texture image = must(device().createTexture({.name = "srgb", .format = Format::RGBA8Srgb, .width = 2, .height = 1, .mips = 0}));
    must(device().upload(image, bytesOf(std::array<std::uint8_t, 8>{255, 255, 255, 255, 0, 0, 0, 255})));
    must(device().run([&](Recorder& recorder) { return recorder.generateMips(image); }));
    // Linear 0.5 encodes to 187.5; a mean of the bytes would be 127.5. llvmpipe filters 8-bit texels in steps of about 1/255.
    EXPECT_NEAR(fromBytes<std::uint8_t>(must(device().readback(image, 1))).front(), 187.5, 2);
}

TEST_F(Textures, a_render_target_with_mips_is_drawn_to_cleared_and_reduced_in_one_frame) {
    Texture source = texture(1, 1, {{8, 4, 2, 1}});
    Texture image = must(
        device().createTexture({.name = "chain", .format = Format::RGBA32F, .width = 8, .height = 8, .mips = 0, .renderTarget = true}));
    const Sampler point = sampler(Filter::Point, Address::Clamp);
    const Pipeline pipeline = reading(copy_frag);
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.clearColor(image, {1, 1, 1, 1}));
        must(recorder.draw({.colors = {&image}}, screenDraw(pipeline, {{0, 1, &source}, {0, 2, &point}})));
        return recorder.generateMips(image);
    }));
    EXPECT_EQ(pixels(image, 3).front(), (Pixel{8, 4, 2, 1}));
}

TEST_F(Textures, a_clear_that_no_draw_follows_still_reaches_the_mip_chain) {
    Texture image = must(
        device().createTexture({.name = "chain", .format = Format::RGBA32F, .width = 4, .height = 4, .mips = 0, .renderTarget = true}));
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.clearColor(image, {1, 2, 3, 4}));
        return recorder.generateMips(image);
    }));
    EXPECT_EQ(pixels(image, 2).front(), (Pixel{1, 2, 3, 4}));
}

TEST_F(Textures, bytes_counts_all_levels_and_faces) {
    const Texture cube =
        must(device().createTexture({.name = "cube", .format = Format::RGBA16F, .width = 4, .height = 4, .mips = 0, .cube = true}));
    EXPECT_EQ(cube.bytes(), (16u + 4u + 1u) * 8u * 6u);
}

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
    return {.minFilter = filter, .magFilter = filter, .mipFilter = filter, .addressU = address, .addressV = address, .addressW = address};
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
