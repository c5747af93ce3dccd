// Batches as a user runs them: mesh by mesh, with one that cannot be read among them.

#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

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
    const Ran second = tegument(prepare(folder, {"--shard", "2/2"}));
    EXPECT_EQ(second.code, 0) << second.out << second.err;
    EXPECT_NE(second.out.find("1 inputs: 1 done"), std::string::npos) << second.out;

    const Ran merged = tegument({"merge", folder + "/done", "--column", "/faces", "-o", folder + "/report.csv"});
    EXPECT_EQ(merged.code, 0) << merged.err;
    const Ran lines = tegument({"merge", folder + "/done", "--json"});
    EXPECT_EQ(std::ranges::count(lines.out, '\n'), 3);
    EXPECT_EQ(lines.out.find("\"state\":\"failed"), std::string::npos) << "the new record has replaced the old";
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
    EXPECT_FALSE(fs::exists(folder + "/done"));
    const Ran dry =
        tegument({"batch", "-i", folder + "/a.obj", "--results", folder + "/done", "--dry-run", "--", "prep", "{}", "-o", "{path}.glb"});
    EXPECT_EQ(dry.out, "tegument prep " + folder + "/a.obj -o " + folder + "/a.glb\n");
    EXPECT_FALSE(fs::exists(folder + "/done"));
}

TEST(SubmitCommand, prints_the_script_and_says_where_slurm_is_missing) {
    const std::string folder = fs::path(write("submit/a.obj", kTriangle)).parent_path().string();
    const std::vector<std::string> submit{"submit", "--slurm", "-i", folder + "/*.obj",     "--results", folder + "/done", "--",
                                          "prep",   "{}",      "-o", folder + "/{name}.glb"};
    const Ran printed = tegument(submit);
    EXPECT_EQ(printed.code, 0) << printed.err;
    EXPECT_NE(printed.out.find("#SBATCH --array=1-1\n"), std::string::npos) << printed.out;
    std::vector<std::string> go = submit;
    go.insert(go.begin() + 2, "--go");
    const Ran gone = tegument(go, {{"PATH", "/nowhere"}});
    EXPECT_EQ(gone.code, 3) << gone.err;
    EXPECT_NE(gone.err.find("TG8110"), std::string::npos) << gone.err;
}

} // namespace
} // namespace tegument::test
