// Order within a frame and between frames: clears, passes that read each other, dispatches, timers, failed recordings.
// The barrier logic by itself: what each use has to wait for.

#include "host/gpu/track.h"
#include "shaders/copy_frag.h"
#include "shaders/march_frag.h"
#include "shaders/prefix_comp.h"
#include "shaders/storage_frag.h"
#include "shaders/uniform_frag.h"
#include "tests/gpu/fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tegument::gpu::detail {
namespace {

class Frames : public Gpu {
protected:
    Pipeline coloring() { return must(device().createPipeline(screen(uniform_frag, {{0, 0}}, {Format::RGBA32F}))); }
};

constexpr Pixel kOne = {1, 1, 1, 1};
constexpr Pixel kTwo = {2, 2, 2, 2};

TEST_F(Frames, fifty_passes_that_read_each_other_are_exact) {
    constexpr int kPasses = 50;
    constexpr int kWidth = 7; // 50 passes go around the edge seven times
    std::vector<Pixel> start;
    for (int x = 0; x < kWidth; ++x)
        start.push_back({static_cast<float>(100 * x), 0, 0, 0});
    Texture images[2] = {target(Format::RGBA32F, kWidth, 1), target(Format::RGBA32F, kWidth, 1)};
    must(device().upload(images[0], bytesOf(start)));
    const Pipeline march = reading(march_frag);
    const Sampler point = sampler(Filter::Point, Address::Clamp);
    must(device().run([&](Recorder& recorder) -> Result<void> {
        for (int pass = 0; pass < kPasses; ++pass)
            must(recorder.draw({.colors = {&images[(pass + 1) % 2]}}, screenDraw(march, {{0, 1, &images[pass % 2]}, {0, 2, &point}})));
        return {};
    }));
    const auto result = pixels(images[kPasses % 2]);
    for (int x = 0; x < kWidth; ++x) {
        const int origin = ((x - kPasses) % kWidth + kWidth) % kWidth;
        EXPECT_EQ(result[static_cast<std::size_t>(x)][0], static_cast<float>(100 * origin + kPasses)) << "texel " << x;
    }
}

TEST_F(Frames, draws_into_one_target_happen_in_order) {
    Texture image = target(Format::RGBA32F, 1, 1);
    PipelineDesc desc = screen(uniform_frag, {{0, 0}}, {Format::RGBA32F});
    desc.state.targets[0] = {.enable = true, .src = BlendFactor::One, .dst = BlendFactor::SrcAlpha, .dstAlpha = BlendFactor::Zero};
    const Pipeline pipeline = must(device().createPipeline(desc));
    must(device().run([&](Recorder& recorder) -> Result<void> {
        for (const float value : {1.0f, 2.0f, 3.0f, 4.0f, 5.0f}) { // x <- value + x / 2
            const Pixel color = {value, 0, 0, 0.5f};
            must(recorder.draw({.colors = {&image}}, screenDraw(pipeline, {{0, 0, bytesOf(color)}})));
        }
        return {};
    }));
    EXPECT_EQ(pixels(image).front()[0], 5 + 4 / 2.0f + 3 / 4.0f + 2 / 8.0f + 1 / 16.0f);
}

TEST_F(Frames, a_clear_between_two_draws_stands_between_them) {
    Texture image = target(Format::RGBA32F, 1, 1);
    PipelineDesc desc = screen(uniform_frag, {{0, 0}}, {Format::RGBA32F});
    desc.state.targets[0] = {.enable = true, .src = BlendFactor::One, .dst = BlendFactor::One, .dstAlpha = BlendFactor::One};
    const Pipeline add = must(device().createPipeline(desc));
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.draw({.colors = {&image}}, screenDraw(add, {{0, 0, bytesOf(kTwo)}})));
        must(recorder.clearColor(image, {10, 10, 10, 10}));
        return recorder.draw({.colors = {&image}}, screenDraw(add, {{0, 0, bytesOf(kOne)}}));
    }));
    EXPECT_EQ(pixels(image).front()[0], 11.0f);
}

TEST_F(Frames, a_draw_reads_a_texture_that_was_only_cleared) {
    Texture source = target(Format::RGBA32F, 1, 1);
    Texture image = target(Format::RGBA32F, 1, 1);
    const Pipeline copy = reading(copy_frag);
    const Sampler point = sampler(Filter::Point, Address::Clamp);
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.clearColor(source, {1, 2, 3, 4}));
        return recorder.draw({.colors = {&image}}, screenDraw(copy, {{0, 1, &source}, {0, 2, &point}}));
    }));
    EXPECT_EQ(pixels(image).front(), (Pixel{1, 2, 3, 4}));
}

TEST_F(Frames, a_clear_after_a_read_does_not_reach_the_reader) {
    Texture source = texture(1, 1, {kOne});
    Texture image = target(Format::RGBA32F, 1, 1);
    const Pipeline copy = reading(copy_frag);
    const Sampler point = sampler(Filter::Point, Address::Clamp);
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.draw({.colors = {&image}}, screenDraw(copy, {{0, 1, &source}, {0, 2, &point}})));
        return recorder.clearColor(source, {9, 9, 9, 9});
    }));
    EXPECT_EQ(pixels(image).front(), kOne);
    EXPECT_EQ(pixels(source).front(), (Pixel{9, 9, 9, 9}));
}

TEST_F(Frames, a_failed_recording_submits_nothing_and_leaves_the_textures_usable) {
    Texture source = texture(1, 1, {kOne});
    Texture image = target(Format::RGBA32F, 1, 1);
    const Pipeline copy = reading(copy_frag);
    const Sampler point = sampler(Filter::Point, Address::Clamp);
    const Draw draw = screenDraw(copy, {{0, 1, &source}, {0, 2, &point}});
    const auto failed = device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.draw({.colors = {&image}}, draw));
        must(recorder.clearColor(source, {5, 5, 5, 5}));
        return usageError(8999, "stop");
    });
    EXPECT_EQ(codeOf(failed), 8999);
    EXPECT_EQ(pixels(image).front(), (Pixel{0, 0, 0, 0}));
    must(drawOnce({.colors = {&image}}, draw)); // wrong layouts would show as validation messages
    EXPECT_EQ(pixels(image).front(), kOne);
}

TEST_F(Frames, copying_a_texture_that_the_recorded_frame_uses_is_refused) {
    Texture image = target(Format::RGBA32F, 1, 1);
    const Pipeline color = coloring();
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.draw({.colors = {&image}}, screenDraw(color, {{0, 0, bytesOf(kOne)}})));
        EXPECT_EQ(codeOf(device().readback(image)), 6043);
        EXPECT_EQ(codeOf(device().upload(image, bytesOf(kTwo))), 6043);
        return {};
    }));
    EXPECT_EQ(pixels(image).front(), kOne);
}

TEST_F(Frames, textures_may_be_created_and_filled_while_recording) {
    Texture image = target(Format::RGBA32F, 1, 1);
    std::optional<Texture> made;
    const Pipeline copy = reading(copy_frag);
    const Sampler point = sampler(Filter::Point, Address::Clamp);
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.clearColor(image, {7, 7, 7, 7}));
        made.emplace(texture(1, 1, {kTwo}));
        return recorder.draw({.colors = {&image}}, screenDraw(copy, {{0, 1, &*made}, {0, 2, &point}}));
    }));
    EXPECT_EQ(pixels(image).front(), kTwo);
}

class Dispatches : public Frames {
protected:
    struct Step {
        std::int32_t count, distance, unused[2];
    };
    Pipeline prefix() {
        return must(device().createPipeline(ComputePipelineDesc{
            .name = "prefix",
            .shader = {.spirv = prefix_comp, .entry = "main"},
            .bindings = {{0, 0, BindingKind::UniformBuffer}, {0, 1, BindingKind::StorageBuffer}, {0, 2, BindingKind::StorageBuffer}}}));
    }
};

TEST_F(Dispatches, that_read_each_others_buffers_wait_for_each_other) {
    // The prefix sum of 1000 integers in ten steps, each reading what the step before wrote.
    constexpr int kCount = 1000;
    std::vector<float> values(kCount);
    std::iota(values.begin(), values.end(), 1.0f);
    Buffer buffers[2] = {must(device().createBuffer(BufferUsage::Storage, bytesOf(values))),
                         must(device().createBuffer(BufferUsage::Storage, bytesOf(values)))};
    const Pipeline pipeline = prefix();
    int source = 0;
    must(device().run([&](Recorder& recorder) -> Result<void> {
        for (int distance = 1; distance < kCount; distance *= 2, source = 1 - source) {
            const Step step{kCount, distance, {}};
            must(recorder.dispatch(pipeline, {{0, 0, objectBytes(step)}, {0, 1, &buffers[source]}, {0, 2, &buffers[1 - source]}},
                                   {(kCount + 63) / 64, 1, 1}));
        }
        return {};
    }));
    const auto sums = fromBytes<float>(must(device().readback(buffers[source])));
    for (int i = 0; i < kCount; ++i) {
        const int sum = (i + 1) * (i + 2) / 2; // below 2^24: exact
        ASSERT_EQ(sums[static_cast<std::size_t>(i)], static_cast<float>(sum)) << i;
    }
}

TEST_F(Dispatches, write_what_draws_of_the_same_frame_read) {
    const std::vector<float> values = {1, 2, 3, 4};
    Buffer input = must(device().createBuffer(BufferUsage::Storage, bytesOf(values)));
    Buffer output = must(device().createBuffer(BufferUsage::Storage, bytesOf(std::vector<float>(4))));
    Texture image = target(Format::RGBA32F, 4, 1);
    const Pipeline compute = prefix();
    const Pipeline show = must(device().createPipeline(screen(storage_frag, {{0, 0, BindingKind::StorageBuffer}}, {Format::RGBA32F})));
    const Step step{4, 1, {}};
    must(device().run([&](Recorder& recorder) -> Result<void> {
        must(recorder.dispatch(compute, {{0, 0, objectBytes(step)}, {0, 1, &input}, {0, 2, &output}}, {1, 1, 1}));
        return recorder.draw({.colors = {&image}}, screenDraw(show, {{0, 0, &output}}));
    }));
    const auto all = pixels(image);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(all[i][0], values[i] + (i > 0 ? values[i - 1] : 0));
}

class Timers : public Frames {};

TEST_F(Timers, report_every_section_by_name_in_order) {
    Texture image = target(Format::RGBA32F, 64, 64);
    const Pipeline color = coloring();
    const auto sections = must(device().run([&](Recorder& recorder) -> Result<void> {
        for (const char* name : {"first", "second", "first"}) {
            recorder.beginTimer(name);
            must(recorder.draw({.colors = {&image}}, screenDraw(color, {{0, 0, bytesOf(kOne)}})));
            recorder.endTimer();
        }
        return {};
    }));
    ASSERT_EQ(sections.size(), 3u);
    EXPECT_EQ(sections[0].name, "first");
    EXPECT_EQ(sections[1].name, "second");
    EXPECT_EQ(sections[2].name, "first");
    for (const TimedSection& section : sections)
        EXPECT_GE(section.milliseconds, 0);
}

TEST_F(Timers, more_work_takes_more_time) {
    if (!device().info().timestamps) GTEST_SKIP() << device().info().name << " has no timestamps";
    Texture small = target(Format::RGBA32F, 8, 8);
    Texture large = target(Format::RGBA32F, 1024, 1024);
    const Pipeline color = coloring();
    const auto frame = [&](Recorder& recorder) -> Result<void> {
        recorder.beginTimer("little");
        must(recorder.draw({.colors = {&small}}, screenDraw(color, {{0, 0, bytesOf(kOne)}})));
        recorder.endTimer();
        recorder.beginTimer("much");
        for (int i = 0; i < 20; ++i)
            must(recorder.draw({.colors = {&large}}, screenDraw(color, {{0, 0, bytesOf(kOne)}})));
        recorder.endTimer();
        return {};
    };
    must(device().run(frame)); // llvmpipe compiles shaders at their first draw
    // Other processes only make a frame slower: the least of several is the frame's own time.
    double little = std::numeric_limits<double>::infinity();
    double much = little;
    for (int i = 0; i < 8; ++i) {
        const auto sections = must(device().run(frame));
        little = std::min(little, sections[0].milliseconds);
        much = std::min(much, sections[1].milliseconds);
    }
    // 20 times 16384 times the pixels, and what each draw costs besides.
    EXPECT_GT(much, 4 * little);
    EXPECT_GT(much, 0);
}

TEST_F(Timers, hundreds_of_sections_in_a_frame_are_all_reported) {
    Texture image = target(Format::RGBA32F, 1, 1);
    const auto frame = [&](Recorder& recorder) -> Result<void> {
        for (int i = 0; i < 300; ++i) {
            recorder.beginTimer(std::to_string(i));
            must(recorder.clearColor(image, {static_cast<float>(i), 0, 0, 0}));
            recorder.endTimer();
        }
        return {};
    };
    for (int repeat = 0; repeat < 2; ++repeat) { // the queries are used again
        const auto sections = must(device().run(frame));
        ASSERT_EQ(sections.size(), 300u);
        EXPECT_EQ(sections[299].name, "299");
        EXPECT_LT(sections[299].milliseconds, 10'000); // a wrapped difference would be centuries
    }
    EXPECT_EQ(pixels(image).front()[0], 299.0f);
}

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

/// A track after these uses.
Track after(std::initializer_list<Use> uses) {
    Track track;
    for (const Use& use : uses)
        static_cast<void>(advance(track, use));
    return track;
}

TEST(Track, a_read_waits_for_the_write_before_it) {
    Track track = after({kColorTarget});
    const auto dependency = advance(track, kSampledByDraw);
    ASSERT_TRUE(dependency);
    EXPECT_EQ(dependency->stages, Stage::eColorAttachmentOutput);
    EXPECT_EQ(dependency->access, Access::eColorAttachmentWrite);
    EXPECT_EQ(dependency->layout, Layout::eColorAttachmentOptimal);
}

TEST(Track, a_second_read_by_the_same_stages_waits_for_nothing) {
    Track track = after({kColorTarget, kSampledByDraw});
    EXPECT_FALSE(advance(track, kSampledByDraw));
}

TEST(Track, a_read_by_other_stages_waits_for_those_that_changed_the_layout) {
    Track track = after({kColorTarget, kSampledByDraw});
    const auto dependency = advance(track, kSampledByDispatch);
    ASSERT_TRUE(dependency);
    EXPECT_EQ(dependency->stages, kDrawStages);
    EXPECT_EQ(dependency->layout, Layout::eShaderReadOnlyOptimal);
    EXPECT_FALSE(advance(track, kSampledByDispatch));
    EXPECT_FALSE(advance(track, kSampledByDraw));
}

TEST(Track, a_write_waits_for_every_reader) {
    Track track = after({kColorTarget, kSampledByDraw, kSampledByDispatch});
    const auto dependency = advance(track, kColorTarget);
    ASSERT_TRUE(dependency);
    EXPECT_EQ(dependency->stages, kDrawStages | Stage::eComputeShader);
    EXPECT_FALSE(dependency->access); // what was only read needs no flushing
}

TEST(Track, a_write_waits_for_the_write_before_it) {
    Track track = after({kColorTarget});
    const auto dependency = advance(track, kColorTarget);
    ASSERT_TRUE(dependency);
    EXPECT_EQ(dependency->stages, Stage::eColorAttachmentOutput);
    EXPECT_EQ(dependency->access, Access::eColorAttachmentWrite);
}

TEST(Track, a_new_buffer_waits_for_nothing) {
    Track track;
    EXPECT_FALSE(advance(track, kVertexInput));
    Track storage;
    EXPECT_FALSE(advance(storage, kStorageInDispatch));
}

TEST(Track, a_new_texture_leaves_the_undefined_layout_without_waiting) {
    Track track;
    const auto dependency = advance(track, kCopyTarget);
    ASSERT_TRUE(dependency);
    EXPECT_EQ(dependency->layout, Layout::eUndefined);
    EXPECT_FALSE(dependency->stages);
}

TEST(Track, dispatches_on_one_storage_buffer_wait_for_each_other) {
    Track track = after({kStorageInDispatch});
    const auto dependency = advance(track, kStorageInDispatch);
    ASSERT_TRUE(dependency);
    EXPECT_EQ(dependency->access, Access::eShaderStorageWrite);
    EXPECT_TRUE(advance(track, kStorageInDraw));
    EXPECT_FALSE(advance(track, kStorageInDraw));
}

} // namespace
} // namespace tegument::gpu::detail
