// Both compilers see the same interface in every entry point of every effect: parameters, types, offsets, resources, semantics.

#include "host/effect/model.h"
#include "host/run/pixels.h"
#include "host/run/target_desc.h"
#include "host/run/values.h"
#include "host/spirv/compile.h"
#include "tests/run/fixture.h"
#include "tests/spirv/missing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

namespace tegument::run {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> effectFiles() {
    std::vector<std::string> files;
    std::error_code code;
    for (const auto& entry : fs::directory_iterator("effects", code))
        if (entry.path().extension() == ".fx") files.push_back(entry.path().string());
    std::ranges::sort(files);
    return files;
}

std::set<std::pair<std::string, ShaderStage>> entryPoints(const Effect& effect) {
    std::set<std::pair<std::string, ShaderStage>> entries;
    for (const Technique& technique : effect.techniques)
        for (const Pass& pass : technique.passes) {
            if (pass.vertexShader) entries.emplace(pass.vertexShader->entry, ShaderStage::Vertex);
            if (pass.pixelShader) entries.emplace(pass.pixelShader->entry, ShaderStage::Pixel);
            if (pass.computeShader) entries.emplace(pass.computeShader->entry, ShaderStage::Compute);
        }
    return entries;
}

void compare(const Effect& effect, const std::string& entry, ShaderStage stage) {
    SCOPED_TRACE(entry);
    const ShaderRequest request{.code = effect.code, .file = effect.file.string(), .entry = entry, .stage = stage};
    const auto dxc = compileShader(request, Compiler::Dxc);
    const auto glslang = compileShader(request, Compiler::Glslang);
    ASSERT_TRUE(dxc) << format(dxc.error());
    ASSERT_TRUE(glslang) << format(glslang.error());
    for (const std::string& difference : compareReflections(dxc->reflection, glslang->reflection))
        ADD_FAILURE() << difference;
}

TEST(EffectFiles, there_are_effects_to_look_at) {
    EXPECT_FALSE(effectFiles().empty()) << "run from the repository's root";
}

class EffectLayouts : public testing::TestWithParam<std::string> {};

TEST_P(EffectLayouts, are_the_same_from_both_compilers_in_every_setting) {
    if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    for (const char* setting : {"0", "1", "2"}) {
        SCOPED_TRACE(setting);
        const auto effect = loadEffect(GetParam(), {.defines = {{"TEGUMENT_SETTING", setting}}});
        ASSERT_TRUE(effect) << format(effect.error());
        for (const auto& [entry, stage] : entryPoints(*effect))
            compare(*effect, entry, stage);
    }
}

INSTANTIATE_TEST_SUITE_P(Effects, EffectLayouts, testing::ValuesIn(effectFiles()),
                         [](const auto& entry) { return fs::path(entry.param).stem().string(); });

Parameter parameter(BaseType base, int rows, int columns, int elements, const std::string& type) {
    return {.name = "gValue", .type = {.base = base, .rows = rows, .columns = columns, .elements = elements, .name = type}};
}

template <class T>
T at(const std::vector<std::byte>& block, std::size_t offset) {
    T value;
    std::memcpy(&value, block.data() + offset, sizeof value);
    return value;
}

TEST(Pack, a_column_major_matrix_is_stored_transposed) {
    const BlockMember member{
        .name = "gValue", .offset = 16, .size = 64, .rows = 4, .columns = 4, .matrixStride = 16, .spirvRowMajor = true};
    Numbers value(16);
    for (std::size_t i = 0; i < 16; ++i)
        value[i] = static_cast<double>(i);
    std::vector<std::byte> block(80);
    ASSERT_TRUE(pack(member, parameter(BaseType::Float, 4, 4, 0, "float4x4"), value, block));
    EXPECT_EQ(at<float>(block, 16 + 4), 4.0F) << "row 1, column 0 follows row 0, column 0";
    EXPECT_EQ(at<float>(block, 16 + 16), 1.0F) << "row 0, column 1 starts the second register";
}

TEST(Pack, a_row_major_matrix_is_stored_row_by_row) {
    const BlockMember member{
        .name = "gValue", .offset = 0, .size = 64, .rows = 4, .columns = 4, .matrixStride = 16, .spirvRowMajor = false};
    Numbers value(16);
    value[1] = 7;
    std::vector<std::byte> block(64);
    ASSERT_TRUE(pack(member, parameter(BaseType::Float, 4, 4, 0, "float4x4"), value, block));
    EXPECT_EQ(at<float>(block, 4), 7.0F);
}

TEST(Pack, array_elements_lie_a_stride_apart) {
    const BlockMember member{.name = "gValue", .offset = 32, .size = 36, .elements = 3, .arrayStride = 16};
    std::vector<std::byte> block(80);
    ASSERT_TRUE(pack(member, parameter(BaseType::Float, 1, 1, 3, "float"), {1, 2, 3}, block));
    EXPECT_EQ(at<float>(block, 32), 1.0F);
    EXPECT_EQ(at<float>(block, 48), 2.0F);
    EXPECT_EQ(at<float>(block, 64), 3.0F);
    EXPECT_EQ(at<std::uint32_t>(block, 36), 0U) << "the gap between elements is untouched";
}

TEST(Pack, integers_and_booleans_are_written_as_32_bit_integers) {
    std::vector<std::byte> block(12);
    ASSERT_TRUE(pack({.name = "gValue", .base = MemberBase::Int, .offset = 0}, parameter(BaseType::Int, 1, 1, 0, "int"), {-3}, block));
    ASSERT_TRUE(pack({.name = "gValue", .base = MemberBase::Uint, .offset = 4}, parameter(BaseType::Bool, 1, 1, 0, "bool"), {1}, block));
    ASSERT_TRUE(
        pack({.name = "gValue", .base = MemberBase::Uint, .offset = 8}, parameter(BaseType::Uint, 1, 1, 0, "uint"), {4294967295.0}, block));
    EXPECT_EQ(at<std::int32_t>(block, 0), -3);
    EXPECT_EQ(at<std::uint32_t>(block, 4), 1U);
    EXPECT_EQ(at<std::uint32_t>(block, 8), 4294967295U);
}

TEST(Pack, a_member_of_another_shape_than_the_parameter_is_an_error) {
    std::vector<std::byte> block(16);
    const auto packed = pack({.name = "gValue", .columns = 4}, parameter(BaseType::Float, 1, 3, 0, "float3"), {1, 2, 3}, block);
    EXPECT_EQ(test::code(packed), 4019);
}

Annotation number(const std::string& name, std::vector<double> values) {
    const auto count = static_cast<int>(values.size());
    return {.name = name, .type = {.base = BaseType::Float, .columns = count, .name = "float"}, .value = std::move(values)};
}

Annotation text(const std::string& name, const std::string& value) {
    return {.name = name, .type = {.base = BaseType::String, .name = "string"}, .value = value};
}

Parameter target(std::vector<Annotation> annotations, const std::string& semantic = "RENDERCOLORTARGET") {
    return {.name = "gMap",
            .type = {.base = BaseType::Texture2D, .name = "Texture2D"},
            .semantic = semantic,
            .annotations = {std::move(annotations)}};
}

constexpr Extent kPictureSize{640, 480};

TEST(Targets, without_a_size_annotation_a_target_has_the_size_of_the_picture) {
    const auto desc = describeTarget(target({}), kPictureSize);
    ASSERT_TRUE(test::succeeded(desc));
    EXPECT_EQ(desc->extent, kPictureSize);
    EXPECT_FALSE(desc->ownSize);
}

TEST(Targets, width_alone_makes_a_square) {
    const auto desc = describeTarget(target({number("Width", {64})}), kPictureSize);
    ASSERT_TRUE(test::succeeded(desc));
    EXPECT_EQ(desc->extent, (Extent{64, 64}));
}

TEST(Targets, viewport_ratio_wins_over_the_other_sizes) {
    const auto desc =
        describeTarget(target({number("Width", {64}), number("Dimensions", {32, 16}), number("viewportratio", {0.5, 0.25})}), kPictureSize);
    ASSERT_TRUE(test::succeeded(desc));
    EXPECT_EQ(desc->extent, (Extent{320, 120}));
}

TEST(Targets, a_viewport_ratio_never_makes_an_empty_target) {
    const auto desc = describeTarget(target({number("ViewportRatio", {0.001, 0.001})}), kPictureSize);
    ASSERT_TRUE(test::succeeded(desc));
    EXPECT_EQ(desc->extent, (Extent{1, 1}));
}

TEST(Targets, dimensions_win_over_width_and_height) {
    const auto desc = describeTarget(target({number("Width", {64}), number("Height", {8}), number("Dimensions", {32, 16})}), kPictureSize);
    ASSERT_TRUE(test::succeeded(desc));
    EXPECT_EQ(desc->extent, (Extent{32, 16}));
}

TEST(Targets, format_names_may_carry_a_prefix_and_any_case) {
    for (const char* name : {"A16B16G16R16F", "D3DFMT_A16B16G16R16F", "FMT_a16b16g16r16f", "A16R16G16B16F"})
        EXPECT_EQ(formatFromD3D(name), gpu::Format::RGBA16F) << name;
}

TEST(Targets, every_reported_format_name_reads_back_as_the_same_format) {
    using enum gpu::Format;
    for (const gpu::Format format : {R8, RGBA8, BGRA8, RGB10A2, R16F, RG16F, RGBA16F, R32F, RG32F, RGBA32F, D16, D24S8, D32F})
        EXPECT_EQ(formatFromD3D(d3dName(format)), format) << d3dName(format);
}

TEST(Targets, a_format_that_cannot_be_a_target_is_an_error) {
    EXPECT_EQ(test::code(describeTarget(target({text("Format", "A8")}), kPictureSize)), 4020);
}

TEST(Targets, a_depth_format_for_a_colour_target_is_an_error) {
    EXPECT_EQ(test::code(describeTarget(target({text("Format", "D24S8")}), kPictureSize)), 4022);
    EXPECT_EQ(test::code(describeTarget(target({text("Format", "R32F")}, "RenderDepthStencilTarget"), kPictureSize)), 4022);
}

TEST(Targets, impossible_sizes_are_errors) {
    for (const double width : {0.0, -4.0, 2.5, 16385.0, std::nan("")})
        EXPECT_EQ(test::code(describeTarget(target({number("Width", {width})}), kPictureSize)), 4021) << width;
}

TEST(Targets, one_mip_level_unless_the_effect_asks_for_more) {
    EXPECT_EQ(describeTarget(target({}), kPictureSize)->mips, 1U);
    EXPECT_EQ(describeTarget(target({number("Levels", {0})}), kPictureSize)->mips, 0U);
    EXPECT_EQ(describeTarget(target({number("MipLevels", {3})}), kPictureSize)->mips, 3U);
}

Image onePixel(std::vector<float> channels, int bits) {
    const auto count = static_cast<int>(channels.size());
    Image image{.width = 1, .height = 1, .channels = count, .pixels = std::move(channels)};
    image.bitsPerChannel = bits;
    return image;
}

TEST(Pixels, eight_bit_srgb_files_are_left_to_the_sampler) {
    EXPECT_EQ(formatFor(onePixel({0, 0, 0}, 8), true), gpu::Format::RGBA8Srgb);
    EXPECT_EQ(formatFor(onePixel({0, 0, 0}, 8), false), gpu::Format::RGBA8);
}

TEST(Pixels, float_files_keep_their_floats) {
    EXPECT_EQ(formatFor(onePixel({0, 0, 0}, 32), true), gpu::Format::RGBA32F);
}

TEST(Pixels, grey_is_spread_and_alpha_filled) {
    const auto bytes = texels(onePixel({0.5F}, 32), gpu::Format::RGBA32F, false);
    EXPECT_TRUE(test::pixelIs(imageFrom(bytes, 1, 1, gpu::Format::RGBA32F), 0, 0, {0.5F, 0.5F, 0.5F, 1}));
}

TEST(Pixels, two_channels_stay_two_in_every_pixel) {
    const Image image{.width = 3, .height = 1, .channels = 2, .pixels = {0.25F, 1, 0.5F, 2, 0.75F, 3}};
    const auto bytes = texels(image, gpu::Format::RG32F, false);
    ASSERT_EQ(bytes.size(), 6 * sizeof(float));
    EXPECT_EQ(std::memcmp(bytes.data(), image.pixels.data(), bytes.size()), 0);
}

TEST(Pixels, decoding_leaves_alpha_alone) {
    const auto bytes = texels(onePixel({0.5F, 0.5F, 0.5F, 0.5F}, 16), gpu::Format::RGBA32F, true);
    const Image image = imageFrom(bytes, 1, 1, gpu::Format::RGBA32F);
    EXPECT_TRUE(test::pixelIs(image, 0, 0, {srgbToLinear(0.5F), srgbToLinear(0.5F), srgbToLinear(0.5F), 0.5F}));
}

TEST(Pixels, every_half_that_is_finite_survives_a_round_trip) {
    for (std::uint32_t bits = 0; bits < 65536; ++bits) {
        if ((bits & 0x7C00U) == 0x7C00U) continue; // infinities and NaN
        const auto half = static_cast<std::uint16_t>(bits);
        std::vector<std::byte> texel(2);
        std::memcpy(texel.data(), &half, 2);
        EXPECT_EQ(texels(imageFrom(texel, 1, 1, gpu::Format::R16F), gpu::Format::R16F, false), texel) << bits;
    }
}

TEST(Pixels, blue_and_red_are_swapped_for_A8R8G8B8) {
    const std::vector<std::byte> bgra = {std::byte{255}, std::byte{51}, std::byte{0}, std::byte{102}};
    EXPECT_TRUE(test::pixelIs(imageFrom(bgra, 1, 1, gpu::Format::BGRA8), 0, 0, {0, 0.2F, 1, 0.4F}, 1e-7F)); // one float rounding
}

TEST(Pixels, ten_bit_channels_have_red_in_the_low_bits) {
    const std::uint32_t packed = 1023U | 3U << 30;
    std::vector<std::byte> texel(4);
    std::memcpy(texel.data(), &packed, 4);
    EXPECT_TRUE(test::pixelIs(imageFrom(texel, 1, 1, gpu::Format::RGB10A2), 0, 0, {1, 0, 0, 1}));
}

} // namespace
} // namespace tegument::run
