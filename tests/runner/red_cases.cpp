// Cases with known ends, which tests/tools/red_test.py runs by name. None of them is a test of the tree.

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace {

TEST(Ends, passes) {}

TEST(Ends, in_part_2_passes) {}

TEST(Ends, is_skipped) {
    GTEST_SKIP() << "it lacks\nsomething";
}

TEST(Ends, fails) {
    ADD_FAILURE() << "on purpose";
}

TEST(Ends, fails_and_is_skipped) {
    ADD_FAILURE() << "on purpose";
    GTEST_SKIP() << "after it failed";
}

TEST(Ends, says_skipped_and_fails) {
    ADD_FAILURE() << "[  SKIPPED ] on purpose";
}

TEST(Ends, crashes) {
    std::raise(SIGKILL);
}

TEST(Ends, is_skipped_and_crashes_at_exit) {
    std::atexit([] { std::raise(SIGKILL); });
    GTEST_SKIP() << "before it crashes";
}

class BrokenSetUp : public testing::Test {
protected:
    static void SetUpTestSuite() { FAIL() << "on purpose"; }
};

TEST_F(BrokenSetUp, never_runs) {}

} // namespace
