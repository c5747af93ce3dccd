// Colours that no target takes.

#include "host/gpu/outputs.h"
#include "host/gpu/spirv.h"
#include "tests/gpu/fixture.h"

#include "shaders/color_frag.h"
#include "shaders/dual_frag.h"
#include "shaders/many_frag.h"
#include "shaders/mrt_frag.h"
#include "shaders/parts_frag.h"

namespace tegument::gpu {
namespace {

constexpr std::uint32_t kOutputClass = 3;
constexpr std::uint32_t kOpVariableWord = 4U << 16U | 59U; // SPIR-V: four words without a first value

int outputs(std::span<const std::uint32_t> words) {
    int found = 0;
    for (std::size_t at = 5; at < words.size(); at += std::max<std::size_t>(1, words[at] >> 16U))
        if (words[at] == kOpVariableWord && words[at + 3] == kOutputClass) ++found;
    return found;
}

TEST(Outputs, that_no_target_takes_become_variables_of_the_shader) {
    ASSERT_EQ(outputs(many_frag), 3);
    for (std::uint32_t targets = 0; targets < 3; ++targets) {
        const auto changed = detail::withoutOutputsFrom(targets, many_frag);
        EXPECT_EQ(outputs(changed), static_cast<int>(targets));
        const auto valid = detail::checkShader(changed, "main", detail::ShaderStage::Pixel, "many");
        EXPECT_TRUE(valid) << format(valid.error());
    }
}

TEST(Outputs, that_targets_take_stay_as_they_are) {
    EXPECT_TRUE(detail::withoutOutputsFrom(3, many_frag).empty());
    EXPECT_TRUE(detail::withoutOutputsFrom(1, color_frag).empty());
    EXPECT_TRUE(detail::withoutOutputsFrom(1, dual_frag).empty()) << "a second source of blending has the location of the first";
    EXPECT_TRUE(detail::withoutOutputsFrom(1, mrt_frag).empty()) << "one variable of eight locations";
    EXPECT_TRUE(detail::withoutOutputsFrom(1, parts_frag).empty()) << "it is read, and written by its parts";
    EXPECT_TRUE(detail::withoutOutputsFrom(1, {}).empty());
}

TEST_F(Gpu, colours_that_no_target_takes_are_dropped_and_the_others_are_drawn) {
    Texture image = target(Format::RGBA32F, 4, 4);
    Texture other = target(Format::RGBA32F, 4, 4);
    const Pipeline one = must(device().createPipeline(screen(many_frag, {}, {Format::RGBA32F})));
    const Pipeline two = must(device().createPipeline(screen(many_frag, {}, {Format::RGBA32F, Format::RGBA32F})));
    must(drawOnce({.colors = {&image}}, screenDraw(one)));
    EXPECT_EQ(pixels(image)[0], (Pixel{0.25F, 0.125F, 0.125F, 1}));
    must(drawOnce({.colors = {&image, &other}}, screenDraw(two)));
    EXPECT_EQ(pixels(other)[5], (Pixel{0.5F, 0.375F, 0.375F, 1}));
}

} // namespace
} // namespace tegument::gpu
