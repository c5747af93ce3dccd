// Times of passes over the last frames.

#include "tools/view/pass_times.h"

#include <gtest/gtest.h>

#include <numeric>

namespace tegument::view {

namespace {

SessionFrame timed(std::vector<std::pair<std::string, double>> passes, std::optional<double> resolve = {}) {
    SessionFrame frame;
    for (auto& [name, milliseconds] : passes)
        frame.passes.push_back(
            {.name = name, .targets = {}, .reads = {}, .writes = {}, .milliseconds = milliseconds, .kept = milliseconds == 0});
    frame.resolveMilliseconds = resolve;
    return frame;
}

} // namespace

TEST(TimesOfPasses, runs_of_one_name_in_a_row_are_one_row) {
    PassTimes times;
    times.note(timed({{"Shadow", 2}, {"Blur", 3}, {"Blur", 4}, {"Final", 5}, {"Blur", 1}}, 0.5));
    ASSERT_EQ(times.passes().size(), 5U);
    EXPECT_EQ(times.passes()[1].runs, 2U);
    EXPECT_EQ(times.passes()[1].milliseconds, 7);
    EXPECT_EQ(times.passes()[4].name, "resolve");
    EXPECT_EQ(times.drawn(), 15.5);
    EXPECT_EQ(times.frames().front(), (std::vector<double>{2, 7, 5, 1, 0.5}));
}

TEST(TimesOfPasses, one_frame_out_of_line_moves_the_smoothed_time_by_a_part_and_many_by_all) {
    PassTimes times;
    for (int i = 0; i < 20; ++i)
        times.note(timed({{"Final", 4}}));
    times.note(timed({{"Final", 40}}));
    EXPECT_GT(times.passes()[0].milliseconds, 4);
    EXPECT_LT(times.passes()[0].milliseconds, 22) << "nearer to what twenty frames took";
    for (int i = 0; i < 40; ++i)
        times.note(timed({{"Final", 40}}));
    EXPECT_NEAR(times.passes()[0].milliseconds, 40, 0.1);
}

TEST(TimesOfPasses, what_was_kept_has_its_last_time_and_none_in_the_frame) {
    PassTimes times;
    times.note(timed({{"Shadow", 8}, {"Final", 4}}, 1));
    times.note(timed({{"Shadow", 0}, {"Final", 4}}, 1));
    EXPECT_TRUE(times.passes()[0].kept);
    EXPECT_EQ(times.passes()[0].milliseconds, 8);
    EXPECT_EQ(times.frames().back()[0], 0);
    EXPECT_EQ(times.drawn(), 5);
    EXPECT_EQ(times.all(), 13);
}

TEST(TimesOfPasses, a_frame_without_resolve_keeps_what_was_known) {
    PassTimes times;
    times.note(timed({{"Final", 4}}));
    times.note(timed({{"Final", 4}}, 2));
    times.note(timed({{"Final", 4}}));
    ASSERT_EQ(times.passes().size(), 2U);
    EXPECT_EQ(times.frames().size(), 3U);
    EXPECT_TRUE(times.passes()[1].kept);
    EXPECT_EQ(times.passes()[1].milliseconds, 2);
    for (const auto& frame : times.frames())
        EXPECT_EQ(frame.size(), 2U);
}

TEST(TimesOfPasses, other_passes_begin_anew_and_the_history_has_an_end) {
    PassTimes times;
    for (std::size_t i = 0; i < PassTimes::kMostFrames + 10; ++i)
        times.note(timed({{"A", static_cast<double>(i + 1)}}));
    EXPECT_EQ(times.frames().size(), PassTimes::kMostFrames);
    EXPECT_EQ(times.frames().back()[0], static_cast<double>(PassTimes::kMostFrames + 10)) << "the newest is last";
    times.note(timed({{"B", 3}}));
    EXPECT_EQ(times.frames().size(), 1U);
    EXPECT_EQ(times.passes()[0].milliseconds, 3);
}

} // namespace tegument::view
