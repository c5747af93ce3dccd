#include "host/support/process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace tegument::test {
namespace {

Result<ProcessResult> shell(const std::string& script, double timeoutSeconds = 20) {
    return runProcess({.arguments = {"sh", "-c", script}, .environment = {}}, timeoutSeconds);
}

TEST(Process, output_and_exit_code_come_back) {
    const auto result = shell("echo out; echo err >&2; exit 7");
    ASSERT_TRUE(result) << format(result.error());
    EXPECT_EQ(result->output, "out\nerr\n");
    EXPECT_EQ(result->exitCode, 7);
    EXPECT_FALSE(result->timedOut);
}

TEST(Process, arguments_reach_the_program_as_they_are) {
    const auto result = runProcess({.arguments = {"printf", "%s|", "a b", "$HOME", "\"q\"", ""}, .environment = {}}, 20);
    ASSERT_TRUE(result) << format(result.error());
    EXPECT_EQ(result->output, "a b|$HOME|\"q\"||");
}

TEST(Process, variables_replace_ours) {
    ::setenv("TEGUMENT_PROCESS_TEST", "ours", 1);
    const auto result =
        runProcess({.arguments = {"sh", "-c", "echo $TEGUMENT_PROCESS_TEST"}, .environment = {{"TEGUMENT_PROCESS_TEST", "theirs"}}}, 20);
    ::unsetenv("TEGUMENT_PROCESS_TEST");
    ASSERT_TRUE(result) << format(result.error());
    EXPECT_EQ(result->output, "theirs\n");
}

TEST(Process, a_megabyte_of_output_is_not_cut) {
    const auto result = shell("head -c 1000000 /dev/zero | tr '\\0' x");
    ASSERT_TRUE(result) << format(result.error());
    EXPECT_EQ(result->output.size(), 1000000U);
}

TEST(Process, a_program_that_hangs_is_killed_with_its_children) {
    const auto start = std::chrono::steady_clock::now();
    const auto result = shell("sleep 61 & echo $!; wait", 0.5);
    ASSERT_TRUE(result) << format(result.error());
    EXPECT_TRUE(result->timedOut);
    EXPECT_EQ(result->exitCode, 128 + SIGKILL);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    const pid_t child = std::stoi(result->output);
    for (int i = 0; i < 200 && ::kill(child, 0) == 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_NE(::kill(child, 0), 0) << "the background child survived";
}

TEST(Process, one_that_leaves_a_child_with_its_output_open_has_ended) {
    const auto start = std::chrono::steady_clock::now();
    const auto result = shell("sleep 5 & echo done");
    ASSERT_TRUE(result) << format(result.error());
    EXPECT_EQ(result->output, "done\n");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(4));
}

TEST(Process, a_signal_is_128_and_its_number) {
    const auto result = shell("kill -TERM $$");
    ASSERT_TRUE(result) << format(result.error());
    EXPECT_EQ(result->exitCode, 128 + SIGTERM);
}

TEST(Process, a_missing_program_is_an_error_that_names_it) {
    const auto result = runProcess({.arguments = {"tegument-no-such-program"}, .environment = {}}, 20);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().blame, Blame::Machine);
    EXPECT_EQ(result.error().diagnostics[0].code, 5003);
    EXPECT_NE(result.error().diagnostics[0].text.find("tegument-no-such-program"), std::string::npos);
}

TEST(Process, a_folder_is_no_program) {
    EXPECT_FALSE(findProgram("/tmp"));
}

TEST(BackgroundProcess, its_lines_can_be_read_while_it_runs) {
    auto process = BackgroundProcess::start({.arguments = {"sh", "-c", "echo first; sleep 60"}, .environment = {}});
    ASSERT_TRUE(process) << format(process.error());
    EXPECT_EQ(process->readLine(20), "first");
    EXPECT_TRUE(process->running());
}

TEST(BackgroundProcess, lines_that_come_together_are_read_one_by_one) {
    auto process = BackgroundProcess::start({.arguments = {"sh", "-c", "printf 'first\\nsecond\\n'; sleep 60"}, .environment = {}});
    ASSERT_TRUE(process) << format(process.error());
    EXPECT_EQ(process->readLine(20), "first");
    EXPECT_EQ(process->readLine(20), "second");
}

TEST(BackgroundProcess, a_silent_one_gives_no_line) {
    auto process = BackgroundProcess::start({.arguments = {"sleep", "60"}, .environment = {}});
    ASSERT_TRUE(process) << format(process.error());
    EXPECT_FALSE(process->readLine(0.1));
}

TEST(BackgroundProcess, destruction_ends_it) {
    pid_t id = 0;
    {
        auto process = BackgroundProcess::start({.arguments = {"sh", "-c", "echo $$; exec sleep 60"}, .environment = {}});
        ASSERT_TRUE(process) << format(process.error());
        id = std::stoi(process->readLine(20).value_or("0"));
        ASSERT_GT(id, 0);
    }
    EXPECT_NE(::kill(id, 0), 0);
}

} // namespace
} // namespace tegument::test
