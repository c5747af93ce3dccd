// How far the work is, and when it will be done.
#include "tools/cli/progress.h"

#include <gtest/gtest.h>

using tegument::app::durationText;
using tegument::app::Estimate;

TEST(Estimate, of_a_count_is_what_the_items_so_far_took) {
    Estimate estimate;
    estimate.say("frame 1 of 11", 10);
    EXPECT_FALSE(estimate.left(10)) << "nothing is done yet";
    estimate.say("frame 3 of 11", 14);
    EXPECT_NEAR(*estimate.left(14), 16, 1e-9) << "2 s each, 8 to come";
    estimate.say("frame 11 of 11", 30);
    EXPECT_NEAR(*estimate.left(30), 0, 1e-9);
}

TEST(Estimate, begins_anew_where_another_count_begins) {
    Estimate estimate;
    estimate.say("reference: pixel 0 of 100", 0);
    estimate.say("reference: pixel 90 of 100", 90);
    estimate.say("preparing Main (1 of 3)", 100);
    EXPECT_FALSE(estimate.left(101)) << "what the reference took says nothing of it";
    estimate.say("preparing Main (2 of 3)", 104);
    EXPECT_NEAR(*estimate.left(104), 4, 1e-9);
    estimate.say("preparing Main (1 of 3)", 110);
    EXPECT_FALSE(estimate.left(110)) << "the next round";
}

TEST(Estimate, of_expected_steps_is_of_all_of_them) {
    Estimate estimate;
    estimate.expect({{"mesh", 1}, {"maps", 3}, {"write", 1}});
    estimate.say("mesh", 2);
    EXPECT_FALSE(estimate.left(3));
    estimate.say("maps of 2048 texels", 4);
    EXPECT_NEAR(*estimate.left(4), 8, 1e-9) << "1 of 5 took 2 s";
    estimate.count(1, 3, 6); // a loop within the step
    EXPECT_NEAR(*estimate.left(6), 6, 1e-9) << "2 of 5 took 4 s";
    estimate.say("write", 10);
    EXPECT_NEAR(*estimate.left(10), 2, 1e-9);
}

TEST(Estimate, is_said_once_it_is_worth_saying) {
    Estimate estimate;
    estimate.say("drawing the cube map", 0);
    EXPECT_EQ(estimate.line(1), "drawing the cube map");
    EXPECT_EQ(estimate.line(12), "drawing the cube map, 12 s");
    estimate.count(1, 5, 12);
    estimate.count(2, 5, 14);
    EXPECT_EQ(estimate.line(14), "drawing the cube map, 40 %, 14 s, about 6 s left");
    estimate.say("compiling shader 3 of 19", 20);
    EXPECT_EQ(estimate.line(20), "compiling shader 3 of 19");
}

TEST(Estimate, takes_no_other_numbers_for_a_count) {
    Estimate estimate;
    for (const char* text : {"step 5 of", "of 7", "7 of many", "9 of 3", "0 of 0"}) {
        estimate.say(text, 0);
        estimate.say(text, 5);
        EXPECT_FALSE(estimate.left(6)) << text;
    }
}

TEST(Durations, are_read_at_a_glance) {
    EXPECT_EQ(durationText(0.4), "0 s");
    EXPECT_EQ(durationText(59.4), "59 s");
    EXPECT_EQ(durationText(61), "1 min 01 s");
    EXPECT_EQ(durationText(3599.6), "60 min 00 s");
}
