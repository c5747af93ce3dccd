// The front, the pick, and the command that draws what was picked.

#include "lab/bench/choice.h"

#include <gtest/gtest.h>

using namespace tegument;
using namespace tegument::bench;

namespace {

Row row(double milliseconds, double error) {
    Row row;
    row.drawn.milliseconds.median = milliseconds;
    row.errors.relativeL2 = error;
    return row;
}

/// Fast and rough, in the middle, slow and exact; one that is beaten in both, and one that failed.
std::vector<Row> five() {
    std::vector<Row> rows = {row(4, 0.001), row(1, 0.1), row(2, 0.01), row(3, 0.05), row(0, 0)};
    rows.back().failure = inputError(4001, {}, "no such technique");
    return rows;
}

} // namespace

TEST(Choice, the_front_holds_what_nothing_beats_in_both) {
    EXPECT_EQ(paretoFront(five()), (std::vector<std::size_t>{1, 2, 0}));
}

TEST(Choice, of_two_equal_rows_one_is_on_the_front) {
    EXPECT_EQ(paretoFront({row(1, 0.1), row(1, 0.1)}).size(), 1);
}

TEST(Choice, takes_the_cheapest_within_an_error) {
    EXPECT_EQ(pick(five(), {.error = 0.05, .milliseconds = {}}), 2);
    EXPECT_EQ(pick(five(), {.error = 0.5, .milliseconds = {}}), 1);
}

TEST(Choice, takes_the_most_accurate_within_a_time) {
    EXPECT_EQ(pick(five(), {.error = {}, .milliseconds = 3.5}), 2);
    EXPECT_EQ(pick(five(), {.error = {}, .milliseconds = 10}), 0);
}

TEST(Choice, takes_nothing_where_nothing_keeps_the_limit) {
    EXPECT_EQ(pick(five(), {.error = 1e-4, .milliseconds = {}}), std::nullopt);
    EXPECT_EQ(pick(five(), {.error = {}, .milliseconds = 0.5}), std::nullopt);
}

TEST(Choice, the_command_carries_everything_that_was_measured) {
    Row chosen = row(1, 0.1);
    chosen.contender = {.technique = "Gosselin",
                        .setting = "seed",
                        .variant = {},
                        .source = {},
                        .effect = "effects/Main.fx",
                        .defines = {{"TEGUMENT_SETTING", "0"}, {"X", "a b"}},
                        .parameters = {{"gBlurCount", {2}}, {"gTint", {1, 0.5}}}};
    chosen.mapSize = 512;
    chosen.shadowSize = 1024;
    chosen.width = 64;
    chosen.height = 32;
    chosen.workspace = "my scene.json";
    EXPECT_EQ(renderCommand(chosen), "tegument render effects/Main.fx -t Gosselin --setting seed -D 'X=a b' -s gBlurCount=2 -s gTint=1,0.5 "
                                     "--map-size 512 --shadow-size 1024 --size 64x32 -w 'my scene.json'");
}
