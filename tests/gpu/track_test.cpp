// The barrier logic by itself: what each use has to wait for.

#include "host/gpu/track.h"

#include <gtest/gtest.h>

namespace tegument::gpu::detail {
namespace {

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
