// Batches as a user runs them: mesh by mesh, with one that cannot be read among them.

#include "host/support/file.h"
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <random>
#include <set>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

std::vector<std::string> prepare(const std::string& folder, std::vector<std::string> first = {}) {
    const std::vector<std::string> command{"-i", folder + "/*.obj",      "--results", folder + "/done", "--", "prep", "{}",
                                           "-o", folder + "/{name}.glb", "--json"};
    first.insert(first.begin(), "batch");
    first.insert(first.end(), command.begin(), command.end());
    return first;
}

TEST(BatchCommand, does_what_can_be_done_and_names_what_cannot) {
    const std::string folder = fs::path(write("batch/a.obj", kTriangle)).parent_path().string();
    (void)write("batch/b.obj", "v 0 0 0\nf 1 2 x\n");
    (void)write("batch/c.obj", kTriangle);
    const Ran first = tegument(prepare(folder));
    EXPECT_EQ(first.code, 1) << first.err;
    EXPECT_NE(first.out.find("b.obj: failed (1)"), std::string::npos) << first.out;
    EXPECT_NE(first.out.find("error TG5302"), std::string::npos) << "with its own message: " << first.out;
    EXPECT_NE(first.out.find("3 inputs: 2 done, 0 done before, 1 failed"), std::string::npos) << first.out;
    EXPECT_TRUE(fs::exists(folder + "/a.glb") && fs::exists(folder + "/c.glb"));

    (void)write("batch/b.obj", kTriangle);
    const Ran second = tegument(prepare(folder));
    EXPECT_EQ(second.code, 0) << second.out << second.err;
    EXPECT_NE(second.out.find("3 inputs: 1 done, 2 done before, 0 failed"), std::string::npos) << second.out;

    const Ran report = tegument({"batch", "--results", folder + "/done", "--column", "/output/faces", "--report", folder + "/report.html"});
    EXPECT_EQ(report.code, 0) << report.err;
    const auto page = readFile(folder + "/report.html");
    ASSERT_TRUE(page);
    EXPECT_NE(page->find("a.obj\",\"done\","), std::string::npos);
    const Ran lines = tegument({"batch", "--results", folder + "/done", "--json"});
    EXPECT_EQ(std::ranges::count(lines.out, '\n'), 3);
    EXPECT_EQ(lines.out.find("\"state\":\"failed"), std::string::npos) << "the new record has replaced the old";
    EXPECT_NE(tegument({"batch", "--results", folder + "/done"}).out.find("c.obj  "), std::string::npos);
    EXPECT_NE(tegument({"batch", "--results", folder + "/nothing"}).err.find("TG8106"), std::string::npos);
}

TEST(BatchCommand, an_effect_counts_with_all_that_it_includes) {
    const std::string folder = fs::path(write("included/own.fxh", "float gValue = 1;\n")).parent_path().string();
    (void)write(
        "included/e.fx",
        "#include \"own.fxh\"\nfloat4 VS() : SV_Position { return gValue; }\nfloat4 PS() : SV_Target0 { return 1; }\n"
        "technique10 T { pass P { SetVertexShader(CompileShader(vs_4_0, VS())); SetPixelShader(CompileShader(ps_4_0, PS())); } }\n");
    const std::vector<std::string> check{"batch", "-i", folder + "/e.fx", "--results",    folder + "/done", "--",
                                         "check", "{}", "--target",       "spirv-glslang"};
    EXPECT_NE(tegument(check).out.find("1 done, 0 done before"), std::string::npos);
    EXPECT_NE(tegument(check).out.find("0 done, 1 done before"), std::string::npos);
    (void)write("included/own.fxh", "float gValue = 2;\n");
    EXPECT_NE(tegument(check).out.find("1 done, 0 done before"), std::string::npos);
}

TEST(BatchCommand, refuses_before_it_runs_anything) {
    const std::string folder = fs::path(write("refused/a.obj", kTriangle)).parent_path().string();
    (void)write("refused/below/a.obj", kTriangle);
    const auto refused = [&](const std::vector<std::string>& words, const std::string& code) {
        std::vector<std::string> arguments{"batch", "-i", folder + "/a.obj", folder + "/below/a.obj", "--results", folder + "/done", "--"};
        arguments.insert(arguments.end(), words.begin(), words.end());
        const Ran ran = tegument(arguments);
        EXPECT_EQ(ran.code, 2) << ran.err;
        EXPECT_NE(ran.err.find(code), std::string::npos) << ran.err;
    };
    refused({"perp", "{}"}, "TG8107");
    refused({"batch", "{}"}, "TG8107");
    refused({"prep", "a.obj"}, "TG8103");
    refused({"prep", "{}", "-o", folder + "/{name}.glb"}, "TG8104");
    refused({"prep", "{}", "-o", folder + "/one.glb"}, "TG8104");
    refused({"prep", "{}", "--dry-run", "--report=" + folder + "/one.json"}, "TG8104");
    refused({"prep", "links", "{}"}, "TG8104");
    refused({"render", "Main", "--mesh", "{}"}, "TG8104");
    refused({"prep", "{}", "-o", folder + "/../refused/below/a.obj"}, "TG8104");
    EXPECT_FALSE(fs::exists(folder + "/done"));
    const Ran dry =
        tegument({"batch", "-i", folder + "/a.obj", "--results", folder + "/done", "--dry-run", "--", "prep", "{}", "-o", "{path}.glb"});
    EXPECT_EQ(dry.out, "tegument prep " + folder + "/a.obj -o " + folder + "/a.glb\n");
    EXPECT_FALSE(fs::exists(folder + "/done"));
}

TEST(BatchCommand, takes_inputs_right_before_the_command) {
    const std::string folder = fs::path(write("last/a.obj", kTriangle)).parent_path().string();
    const Ran ran = tegument({"batch", "--results", folder + "/done", "-i", folder + "/a.obj", "--", "prep", "{}", "-o", "{path}.glb"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_TRUE(fs::exists(folder + "/a.glb"));
}

/// A thousand outputs are deleted, cut or changed at random; each is made again, bit by bit, and no other.
TEST(BatchCommand, makes_again_each_output_that_is_gone_cut_or_changed) {
    constexpr int kInputs = 40;
    constexpr int kRounds = 25;
    constexpr std::size_t kDamaged = 40;
    std::vector<std::string> outputs;
    std::map<std::string, std::string> whole;
    std::string folder;
    for (int i = 0; i < kInputs; ++i) {
        const std::string effect = write("damaged/e" + std::to_string(i) + ".fx", "float gValue = " + std::to_string(i) + ";\n");
        folder = fs::path(effect).parent_path().string();
        outputs.push_back(folder + "/flat/e" + std::to_string(i) + ".fx");
    }
    const std::vector<std::string> batch{"batch", "-j",      "4",  "--results", folder + "/done",          "-i", folder + "/*.fx",
                                         "--",    "flatten", "{}", "-o",        folder + "/flat/{name}.fx"};
    ASSERT_EQ(tegument(batch).code, 0);
    for (const std::string& file : outputs)
        whole[file] = *readFile(file);
    std::mt19937 random(7);
    std::size_t damaged = 0;
    for (int round = 0; round < kRounds; ++round) {
        std::set<std::string> hit;
        for (std::size_t i = 0; i < kDamaged; ++i) {
            const std::string& file = outputs[random() % outputs.size()];
            const std::string& content = whole[file];
            hit.insert(file);
            ++damaged;
            switch (random() % 3) {
            case 0: fs::remove(file); break;
            case 1: ASSERT_TRUE(writeFile(file, content.substr(0, random() % content.size()))); break;
            default: {
                std::string changed = content;
                changed[random() % changed.size()] ^= 1;
                ASSERT_TRUE(writeFile(file, changed));
            }
            }
        }
        const Ran ran = tegument(batch);
        ASSERT_EQ(ran.code, 0) << ran.out << ran.err;
        const std::string expected = std::to_string(hit.size()) + " done, " + std::to_string(outputs.size() - hit.size()) + " done before";
        EXPECT_NE(ran.out.find(expected), std::string::npos) << expected << ": " << ran.out;
        for (const auto& [file, content] : whole)
            ASSERT_EQ(*readFile(file), content) << file;
    }
    EXPECT_EQ(damaged, 1000U);
}

} // namespace
} // namespace tegument::test
