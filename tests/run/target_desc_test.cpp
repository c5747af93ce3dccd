#include "host/run/target_desc.h"
#include "tests/run/fixture.h"

namespace tegument::run {
namespace {

Annotation number(const std::string& name, std::vector<double> values) {
    const auto count = static_cast<int>(values.size());
    return {.name = name, .type = {.base = BaseType::Float, .columns = count, .name = "float"}, .value = std::move(values), .at = {}};
}

Annotation text(const std::string& name, const std::string& value) {
    return {.name = name, .type = {.base = BaseType::String, .name = "string"}, .value = value, .at = {}};
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

} // namespace
} // namespace tegument::run
