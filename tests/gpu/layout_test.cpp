// What the recorder tells Vulkan about attachments. Debian's validation layer (1.3.239) checks neither layouts nor hazards of attachments
// under dynamic rendering, so these tests look at the recorder's own state; the barriers follow from it (track_test.cpp).
// Colours that no target takes.

#include "host/gpu/recorder_state.h"
#include "host/gpu/spirv.h"
#include "host/spirv/validate.h"
#include "shaders/color_frag.h"
#include "shaders/copy_frag.h"
#include "shaders/dual_frag.h"
#include "shaders/many_frag.h"
#include "shaders/mrt_frag.h"
#include "shaders/parts_frag.h"
#include "shaders/uniform_frag.h"
#include "tests/gpu/fixture.h"

#include <algorithm>

namespace tegument::gpu {
namespace {

using Layout = vk::ImageLayout;

Layout layoutOf(const Texture& texture) {
    return texture.state->track.layout;
}

class Recording : public Drawing {
protected:
    void SetUp() override {
        Drawing::SetUp();
        if (IsSkipped()) return;
        PipelineDesc desc = screen(uniform_frag, {{0, 0}}, {Format::RGBA32F});
        desc.depthFormat = Format::D32F;
        colorAndDepth_ = must(device().createPipeline(desc));
    }

    Draw colorDraw() { return screenDraw(color_, {{0, 0, bytesOf(white_)}}); }
    std::size_t scopesOpened() { return image_.state->device->recording->scopesOpened; }

    Pipeline colorAndDepth_;
};

TEST_F(Recording, targets_are_in_attachment_layouts_and_read_textures_in_the_read_only_layout) {
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.draw({.colors = {&image_}, .depth = &depth_}, screenDraw(colorAndDepth_, {{0, 0, bytesOf(white_)}})));
        EXPECT_EQ(layoutOf(image_), Layout::eColorAttachmentOptimal);
        EXPECT_EQ(layoutOf(depth_), Layout::eDepthStencilAttachmentOptimal);
        must(recorder.draw({.colors = {&other_}}, copyDraw(image_)));
        EXPECT_EQ(layoutOf(image_), Layout::eShaderReadOnlyOptimal);
        EXPECT_EQ(layoutOf(other_), Layout::eColorAttachmentOptimal);
        must(recorder.draw({.colors = {&image_}}, copyDraw(depth_)));
        EXPECT_EQ(layoutOf(depth_), Layout::eShaderReadOnlyOptimal);
        EXPECT_EQ(layoutOf(image_), Layout::eColorAttachmentOptimal);
        return {};
    }));
}

TEST_F(Recording, consecutive_draws_to_the_same_targets_share_one_rendering_scope) {
    must(device().run([&](Recorder& recorder) -> Result<void> {
        for (int i = 0; i < 5; ++i)
            must(recorder.draw({.colors = {&image_}}, colorDraw()));
        EXPECT_EQ(scopesOpened(), 1u);
        return {};
    }));
}

TEST_F(Recording, other_targets_a_clear_or_a_texture_to_wait_for_open_a_new_scope) {
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.draw({.colors = {&image_}}, colorDraw()));
        must(recorder.draw({.colors = {&other_}}, colorDraw()));
        EXPECT_EQ(scopesOpened(), 2u);
        must(recorder.clearColor(other_, white_));
        must(recorder.draw({.colors = {&other_}}, colorDraw()));
        EXPECT_EQ(scopesOpened(), 3u);
        must(recorder.draw({.colors = {&other_}}, copyDraw(image_))); // image_ was written in this frame
        EXPECT_EQ(scopesOpened(), 4u);
        must(recorder.draw({.colors = {&other_}}, copyDraw(image_))); // and has been waited for
        EXPECT_EQ(scopesOpened(), 4u);
        return {};
    }));
}

TEST_F(Recording, a_clear_before_a_draw_costs_no_command_of_its_own) {
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.clearColor(image_, {0, 0, 0, 1}));
        EXPECT_EQ(image_.state->device->recording->clears.size(), 1u);
        must(recorder.draw({.colors = {&image_}}, colorDraw()));
        EXPECT_TRUE(image_.state->device->recording->clears.empty());
        EXPECT_EQ(layoutOf(image_), Layout::eColorAttachmentOptimal); // cleared by its load operation, never a copy target
        return {};
    }));
}

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
        EXPECT_EQ(spirv::validate(changed), "");
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
