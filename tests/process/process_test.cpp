#include "tools/process/process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tegument::test {
namespace {

Result<ProcessResult> shell(const std::string& script, double timeoutSeconds = 20) {
    return runProcess({.arguments = {"sh", "-c", script}}, timeoutSeconds);
}

/// One letter of the system: R runs, S sleeps, Z has ended and nobody has waited for it; 0: there is no such process.
char stateOf(pid_t id) {
    std::ifstream file("/proc/" + std::to_string(id) + "/stat");
    std::string number;
    std::string name;
    char state = 0;
    file >> number >> name >> state; // names of the programs here hold no space
    return file ? state : '\0';
}

bool runs(pid_t id) {
    const char state = stateOf(id);
    return state != 0 && state != 'Z';
}

template <class Condition>
bool within(std::chrono::milliseconds time, Condition condition) {
    for (const auto end = std::chrono::steady_clock::now() + time; std::chrono::steady_clock::now() < end;) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return condition();
}

/// A shell in the background and the number that is its first line.
struct Background {
    BackgroundProcess process;
    pid_t id = 0;
};

Background background(const std::string& script) {
    auto started = BackgroundProcess::start({.arguments = {"sh", "-c", script}});
    EXPECT_TRUE(started) << format(started.error());
    Background result{.process = std::move(*started)};
    result.id = std::stoi(result.process.readLine(20).value_or("0"));
    EXPECT_GT(result.id, 0);
    return result;
}

TEST(Process, output_and_exit_code_come_back) {
    const auto result = shell("echo out; echo err >&2; exit 7");
    ASSERT_TRUE(result) << format(result.error());
    EXPECT_EQ(result->output, "out\nerr\n");
    EXPECT_EQ(result->exitCode, 7);
    EXPECT_FALSE(result->timedOut);
}

TEST(Process, arguments_reach_the_program_as_they_are) {
    const auto result = runProcess({.arguments = {"printf", "%s|", "a b", "$HOME", "\"q\"", ""}}, 20);
    ASSERT_TRUE(result) << format(result.error());
    EXPECT_EQ(result->output, "a b|$HOME|\"q\"||");
}

TEST(Process, variables_replace_ours_and_one_without_a_value_is_not_passed_on) {
    ::setenv("TEGUMENT_PROCESS_TEST", "ours", 1);
    for (const auto& [value, said] : {std::pair("theirs", "theirs\n"), std::pair("", "unset\n")}) {
        const auto result = runProcess(
            {.arguments = {"sh", "-c", "echo ${TEGUMENT_PROCESS_TEST-unset}"}, .environment = {{"TEGUMENT_PROCESS_TEST", value}}}, 20);
        ASSERT_TRUE(result) << format(result.error());
        EXPECT_EQ(result->output, said);
    }
    ::unsetenv("TEGUMENT_PROCESS_TEST");
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

TEST(Process, a_lost_exit_code_is_an_error_and_no_success) {
    const auto before = ::signal(SIGCHLD, SIG_IGN); // the system waits for children then, and tells nobody
    const auto result = shell("exit 7");
    ::signal(SIGCHLD, before);
    ASSERT_FALSE(result) << "exit code " << result->exitCode;
    EXPECT_EQ(result.error().diagnostics[0].code, 5003);
}

TEST(Process, nothing_is_left_to_be_waited_for) {
    ASSERT_TRUE(shell("exit 7"));
    ASSERT_TRUE(shell("sleep 61", 0.05));
    errno = 0;
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
}

TEST(Process, many_threads_may_run_programs_at_once) {
    std::vector<int> codes(8);
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < codes.size(); ++i)
            threads.emplace_back([&codes, i] {
                const auto result = shell("exit " + std::to_string(i));
                codes[i] = result ? result->exitCode : -1;
            });
    }
    for (std::size_t i = 0; i < codes.size(); ++i)
        EXPECT_EQ(codes[i], static_cast<int>(i));
}

TEST(Process, signals_that_the_caller_lets_through_reach_the_program) {
    const auto result = shell("kill -TERM $$; echo survived");
    ASSERT_TRUE(result) << format(result.error());
    EXPECT_EQ(result->output, "") << "the thread that forks blocks signals, and the program must not inherit that";
}

TEST(Process, a_missing_program_is_an_error_that_names_it) {
    const auto result = runProcess({.arguments = {"tegument-no-such-program"}}, 20);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().blame, Blame::Machine);
    EXPECT_EQ(result.error().diagnostics[0].code, 5003);
    EXPECT_NE(result.error().diagnostics[0].text.find("tegument-no-such-program"), std::string::npos);
}

TEST(Process, a_folder_is_no_program) {
    EXPECT_FALSE(findProgram("/tmp"));
}

TEST(BackgroundProcess, its_lines_can_be_read_while_it_runs) {
    auto process = BackgroundProcess::start({.arguments = {"sh", "-c", "echo first; sleep 60"}});
    ASSERT_TRUE(process) << format(process.error());
    EXPECT_EQ(process->readLine(20), "first");
    EXPECT_TRUE(process->running());
}

TEST(BackgroundProcess, lines_that_come_together_are_read_one_by_one) {
    auto process = BackgroundProcess::start({.arguments = {"sh", "-c", "printf 'first\\nsecond\\n'; sleep 60"}});
    ASSERT_TRUE(process) << format(process.error());
    EXPECT_EQ(process->readLine(20), "first");
    EXPECT_EQ(process->readLine(20), "second");
}

TEST(BackgroundProcess, a_silent_one_gives_no_line) {
    auto process = BackgroundProcess::start({.arguments = {"sleep", "60"}});
    ASSERT_TRUE(process) << format(process.error());
    EXPECT_FALSE(process->readLine(0.1));
}

TEST(BackgroundProcess, destruction_ends_it) {
    pid_t id = 0;
    {
        auto process = BackgroundProcess::start({.arguments = {"sh", "-c", "echo $$; exec sleep 60"}});
        ASSERT_TRUE(process) << format(process.error());
        id = std::stoi(process->readLine(20).value_or("0"));
        ASSERT_GT(id, 0);
    }
    EXPECT_NE(::kill(id, 0), 0);
}

TEST(BackgroundProcess, outlives_the_thread_that_started_it) {
    std::optional<Background> started;
    std::thread([&] { started.emplace(background("echo $$; exec sleep 60")); }).join();
    EXPECT_FALSE(within(std::chrono::milliseconds(300), [&] { return !runs(started->id); }));
    EXPECT_TRUE(started->process.running());
}

TEST(BackgroundProcess, ends_with_the_process_that_started_it) {
    const auto orphan = runProcess({.arguments = {TEGUMENT_ORPHAN}}, 30);
    ASSERT_TRUE(orphan) << format(orphan.error());
    ASSERT_EQ(orphan->exitCode, 128 + SIGKILL) << orphan->output;
    const pid_t id = std::stoi(orphan->output);
    EXPECT_TRUE(within(std::chrono::seconds(10), [&] { return !runs(id); }));
}

TEST(BackgroundProcess, keeps_its_number_when_it_has_ended_until_it_is_destroyed) {
    pid_t id = 0;
    {
        Background ended = background("echo $$");
        id = ended.id;
        ASSERT_TRUE(within(std::chrono::seconds(10), [&] { return !ended.process.running(); }));
        EXPECT_EQ(stateOf(id), 'Z') << "waited for too early: the number may be another process's by the time it is signalled";
        EXPECT_FALSE(ended.process.running());
    }
    EXPECT_EQ(stateOf(id), '\0') << "nobody waited for it";
}

TEST(BackgroundProcess, destruction_ends_what_one_that_has_ended_left_in_its_group) {
    pid_t left = 0;
    {
        Background ended = background("sleep 60 & echo $!");
        left = ended.id;
        ASSERT_TRUE(within(std::chrono::seconds(10), [&] { return !ended.process.running(); }));
        EXPECT_TRUE(runs(left));
    }
    EXPECT_TRUE(within(std::chrono::seconds(10), [&] { return !runs(left); }));
}

TEST(BackgroundProcess, a_number_that_is_not_its_own_any_more_is_not_signalled) {
    pid_t left = 0;
    {
        Background ended = background("sleep 60 & echo $!");
        left = ended.id;
        ASSERT_EQ(::waitpid(::getpgid(left), nullptr, 0), ::getpgid(left)); // by someone else: from here on the number may be anybody's
        EXPECT_FALSE(ended.process.running());
    }
    EXPECT_FALSE(within(std::chrono::milliseconds(200), [&] { return !runs(left); })) << "a group was signalled by a number given back";
    ::kill(left, SIGKILL);
}

TEST(BackgroundProcess, one_that_ignores_the_request_to_end_is_killed) {
    pid_t id = 0;
    {
        const Background stubborn = background("trap '' TERM; echo $$; while :; do sleep 1; done");
        id = stubborn.id;
    }
    EXPECT_EQ(stateOf(id), '\0');
}

} // namespace
} // namespace tegument::test
