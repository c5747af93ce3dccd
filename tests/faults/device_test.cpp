// A device that fails at its N-th call, for every N until nothing fails: one clear message, the exit code of a machine's fault, and the
// picture of an earlier run as it was.

#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

constexpr int kMachine = 3; // exit code: docs/command-line.md
constexpr int kMost = 400;  // calls of a kind; the effects below make fewer

const std::string kBefore = "what was there before";

std::map<std::string, std::string> failing(const std::string& kind, int at) {
    return {{"VK_LAYER_PATH", TEGUMENT_FAULT_LAYER},
            {"VK_INSTANCE_LAYERS", "VK_LAYER_TEGUMENT_fault"},
            {"TEGUMENT_FAULT", kind + ":" + std::to_string(at)}};
}

std::string bytesOf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

int count(const std::string& text, const std::string& part) {
    int found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

struct Failing {
    std::string kind;
    std::string code;
    int step = 1; // calls between two tries: a frame makes many of some kinds
};
void PrintTo(const Failing& tested, std::ostream* out) {
    *out << tested.kind;
}
class FailingDevice : public testing::TestWithParam<Failing> {};

TEST_P(FailingDevice, is_one_message_and_leaves_no_half_of_a_picture) {
    const std::string picture = write(GetParam().kind + ".png", kBefore);
    int failures = 0;
    for (int at = 1; at < kMost; at += GetParam().step) {
        const Ran ran = tegument({"render", "tests/adopt/effects/composer_glow.fx", "--size", "32", "--samples", "1", "-o", picture},
                                 failing(GetParam().kind, at));
        if (ran.code == 0) {
            EXPECT_NE(bytesOf(picture), kBefore) << "nothing failed, and nothing was written";
            EXPECT_GE(failures, 3) << "the layer is not asked";
            return;
        }
        ++failures;
        ASSERT_EQ(ran.code, kMachine) << "call " << at << ": " << ran.err;
        EXPECT_EQ(count(ran.err, "error TG"), 1) << "call " << at << ": " << ran.err;
        EXPECT_NE(ran.err.find(GetParam().code), std::string::npos) << "call " << at << ": " << ran.err;
        ASSERT_EQ(bytesOf(picture), kBefore) << "call " << at;
    }
    FAIL() << "still failing at call " << kMost;
}

INSTANTIATE_TEST_SUITE_P(At, FailingDevice,
                         testing::Values(Failing{"memory", "TG6008"}, Failing{"host", "TG6008", 3}, Failing{"lost", "TG6007"}),
                         [](const testing::TestParamInfo<Failing>& tested) { return tested.param.kind; });

/// One picture under the validation layer, its barriers at `which` waiting for nothing: 0 all of them.
Ran unordered(int which) {
    std::map<std::string, std::string> environment = failing("barrier", which);
    const char* own = std::getenv("VK_LAYER_PATH");
    environment["VK_LAYER_PATH"] +=
        std::string(":") + (own != nullptr ? own : "/usr/share/vulkan/explicit_layer.d:/usr/local/share/vulkan/explicit_layer.d");
    const std::string picture = (scratch() / "unordered.exr").string();
    return tegument({"render", "Beckmann", "--size", "32", "--samples", "1", "--validate", "-o", picture}, environment);
}

// That no test hears of the validation layer means something only if it would speak: of Debian 12's too, which does not see attachments.
TEST(Barriers, that_wait_for_nothing_are_heard_and_no_others) {
    const Ran ordered = unordered(kMost);
    if (ordered.err.find("TG6003") != std::string::npos) GTEST_SKIP() << ordered.err;
    ASSERT_EQ(ordered.code, 0) << ordered.err;
    EXPECT_EQ(count(ordered.err, "validation:"), 0) << ordered.err;
    const Ran none = unordered(0);
    EXPECT_EQ(none.code, kMachine) << none.err;
    EXPECT_GE(count(none.err, "validation: "), 1) << none.err;
    EXPECT_TRUE(none.err.find("hazard detected") != std::string::npos || none.err.find("SYNC-HAZARD") != std::string::npos) << none.err;
}

TEST(DyingDriver, is_said_of_the_effect_that_it_dies_of_and_the_others_are_drawn) {
    const std::string text = bytesOf("tests/adopt/effects/vertex_only.fx");
    fs::create_directories(scratch() / "dying");
    for (unsigned i = 0; i < 4 * std::thread::hardware_concurrency(); ++i) // some process gets a second one
        ASSERT_FALSE(write("dying/" + std::to_string(i) + ".fx", text).empty());
    const Ran ran = tegument({"survey", (scratch() / "dying").string(), "--size", "16", "--target", "none", "--json"}, failing("crash", 2));
    ASSERT_EQ(ran.code, 0) << ran.err;
    int dead = 0;
    int drawn = 0;
    const nlohmann::json report = ran.json();
    for (const auto& file : report["files"]) {
        const bool dies = file["drawn"] == "not drawn: TG4071";
        dead += dies ? 1 : 0;
        drawn += dies ? 0 : 1;
        EXPECT_TRUE(dies || file["drawn"] == "drawn") << file.dump(1);
        EXPECT_EQ(dies, file["why"].get<std::string>().find("signal 11") != std::string::npos) << file.dump(1);
    }
    EXPECT_GE(dead, 1);
    EXPECT_GE(drawn, 1);
}

} // namespace
} // namespace tegument::test
