#include "host/support/children.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <shared_mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace tegument::test {
namespace {

constexpr double kPlenty = 60; // seconds: of a busy machine

/// Does what it is told, and says in which process.
std::string obey(std::string_view request) {
    if (request == "crash") std::raise(SIGSEGV);
    if (request == "leave") _exit(3);
    if (request == "hang") pause();
    if (request == "throw") throw std::runtime_error("no");
    if (request == "long") return std::string(5'000'000, 'x');
    return std::to_string(getpid()) + " " + std::string(request);
}

class ChildrenOfOurs : public testing::Test {
protected:
    std::shared_mutex busy_;
    Children children_{obey, busy_};

    std::string ask(const std::string& request) {
        const ChildAnswer answer = children_.ask(request, kPlenty);
        EXPECT_TRUE(answer.answered) << request;
        return answer.bytes;
    }
};

TEST_F(ChildrenOfOurs, answer_from_a_process_of_their_own_that_is_kept) {
    const std::string first = ask("a");
    EXPECT_EQ(first.substr(first.find(' ')), " a");
    EXPECT_NE(first.substr(0, first.find(' ')), std::to_string(getpid()));
    EXPECT_EQ(ask("a"), first);
}

TEST_F(ChildrenOfOurs, may_crash_and_the_next_one_answers) {
    const ChildAnswer crashed = children_.ask("crash", kPlenty);
    EXPECT_FALSE(crashed.answered);
    EXPECT_EQ(crashed.signal, SIGSEGV);
    EXPECT_FALSE(crashed.timedOut);
    EXPECT_FALSE(ask("b").empty());
}

TEST_F(ChildrenOfOurs, may_leave_or_throw) {
    for (const char* request : {"leave", "throw"}) {
        const ChildAnswer left = children_.ask(request, kPlenty);
        EXPECT_FALSE(left.answered) << request;
        EXPECT_EQ(left.signal, 0) << request;
    }
    EXPECT_FALSE(ask("c").empty());
}

TEST_F(ChildrenOfOurs, are_ended_when_they_take_too_long) {
    const ChildAnswer hung = children_.ask("hang", 0.1);
    EXPECT_FALSE(hung.answered);
    EXPECT_TRUE(hung.timedOut);
    EXPECT_FALSE(ask("d").empty());
}

TEST_F(ChildrenOfOurs, carry_long_messages) {
    EXPECT_EQ(ask("long").size(), 5'000'000U);
    const std::string request(3'000'000, 'y');
    EXPECT_TRUE(ask(request).ends_with(request));
}

TEST_F(ChildrenOfOurs, serve_several_threads_at_once) {
    std::vector<std::string> answers(4);
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < answers.size(); ++i)
            threads.emplace_back([&, i] {
                for (int round = 0; round < 20; ++round)
                    answers[i] = children_.ask(round % 5 == 4 && i == 0 ? "crash" : "e" + std::to_string(i), kPlenty).bytes;
            });
    }
    for (std::size_t i = 1; i < answers.size(); ++i)
        EXPECT_TRUE(answers[i].ends_with(" e" + std::to_string(i)));
}

} // namespace
} // namespace tegument::test
