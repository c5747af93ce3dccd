// tegument bench as a user runs it.
// tegument bench --stability as a user runs it.
// tegument verify as a user runs it.

#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

namespace tegument::test {

namespace {

namespace fs = std::filesystem;

/// So small that it takes a second.
std::vector<std::string> tiny(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"bench",
                                          "--scene",
                                          "sphere-5",
                                          "--size",
                                          "40x40",
                                          "--map-size",
                                          "64",
                                          "--frames",
                                          "1",
                                          "--reference",
                                          "64",
                                          "--keep-scenes",
                                          (scratch() / "scenes").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

void expectRefused(const std::vector<std::string>& arguments, const char* code) {
    const Ran ran = tegument(arguments);
    EXPECT_NE(ran.code, 0);
    EXPECT_NE(ran.err.find(code), std::string::npos) << ran.err;
}

/// An effect that divides by zero in every pixel, beside a catalogue that names nothing.
std::string faultyEffects() {
    const fs::path folder = scratch() / "faulty"; // with a copy of ours: an effect reads no file outside of its project
    fs::create_directories(folder / "effects");
    fs::copy("hlsl", folder / "hlsl", fs::copy_options::recursive);
    fs::copy("effects/passes", folder / "effects/passes", fs::copy_options::recursive);
    const std::string effect = write("faulty/Faulty.fx", R"(#include "hlsl/platform.fxh"
#include "hlsl/workspace.fxh"
#include "effects/passes/quad.fxh"
float4 gZero = { 0.0, 0.0, 0.0, 0.0 };
float4 FaultyPS(TgQuadVarying input) : SV_Target0 { return (input.uv.x + 1.0) / gZero; }
#ifdef FX_TECHNIQUES
technique Faulty < string Script = "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Faulty;"; >
{
    TG_QUAD_PASS(Faulty, TgQuadVS, FaultyPS, TG_STATE_BUFFER)
}
#endif
)");
    const std::string catalogue = write("faulty/catalogue.json", "[]");
    EXPECT_EQ(fs::path(effect).parent_path(), fs::path(catalogue).parent_path());
    return catalogue;
}

} // namespace

TEST(Bench, refuses_scenes_and_techniques_that_do_not_exist) {
    expectRefused({"bench", "--scene", "spheer-5"}, "TG8072");
    expectRefused({"bench", "--scene", "sphere-5@up"}, "TG8073");
    expectRefused({"bench", "--technique", "Phong"}, "TG8071");
    expectRefused({"bench", "--catalogue", write("catalogue.json", "{}")}, "TG8070");
}

TEST(Bench, refuses_options_that_mean_nothing) {
    expectRefused({"bench", "--pick"}, "TG8079");
    EXPECT_EQ(tegument({"bench", "--max-error", "0.1"}).code, 2) << "without --pick";
    EXPECT_EQ(tegument({"bench", "--pick", "--max-error", "-1"}).code, 2);
    EXPECT_EQ(tegument({"bench", "--pick", "--max-error", "1", "--max-ms", "1"}).code, 2);
    EXPECT_EQ(tegument({"bench", "--growth", "--ablation"}).code, 2);
    EXPECT_EQ(tegument({"bench", "--frames", "0"}).code, 2);
}

TEST(Bench, refuses_a_reference_of_no_pixels) {
    const Ran ran = tegument({"bench", "--reference", "some"});
    EXPECT_NE(ran.err.find("TG8077"), std::string::npos) << ran.err;
}

TEST(Bench, writes_a_json_list_and_nothing_else) {
    const Ran ran = tegument(tiny({"--technique", "Lambert", "DEonLuebke", "--setting", "corrected", "--json", "-"}));
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto list = ran.json();
    ASSERT_EQ(list.size(), 2);
    EXPECT_GT(list[0]["error"]["rel_l2"].get<double>(), list[1]["error"]["rel_l2"].get<double>()) << "light spreads on a sphere of 5 mm";
    EXPECT_EQ(list[1]["reference"]["pixels"], 64);
}

TEST(Bench, picks_a_technique_with_a_command_that_draws) {
    const Ran ran = tegument(tiny({"--technique", "Lambert", "DEonLuebke", "--setting", "corrected", "--pick", "--max-error", "0.02"}));
    ASSERT_EQ(ran.code, 0) << ran.err;
    const std::string word = "tegument render ";
    const auto at = ran.out.find(word);
    ASSERT_NE(at, std::string::npos) << ran.out;
    std::vector<std::string> arguments = {"render"};
    std::string command = ran.out.substr(at + word.size(), ran.out.find('\n', at) - at - word.size());
    for (std::size_t next = 0; (next = command.find(' ')) != std::string::npos; command = command.substr(next + 1))
        arguments.push_back(command.substr(0, next));
    arguments.push_back(command);
    arguments.insert(arguments.end(), {"-o", (scratch() / "picked.png").string()});
    const Ran drawn = tegument(arguments);
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_TRUE(fs::exists(scratch() / "picked.png"));
}

// Which size is the fastest depends on what else the machine does: the command has one whose time is the least, or ties with it.
TEST(Bench, picks_the_size_of_the_maps_too_where_none_is_named) {
    const Ran ran = tegument({"bench", "--scene", "sphere-5", "--size", "40x40", "--frames", "1", "--reference", "64", "--technique",
                              "Pyramid", "--pick", "--max-error", "0.5", "--keep-scenes", (scratch() / "scenes").string()});
    ASSERT_EQ(ran.code, 0) << ran.err;
    std::map<double, int> sizes; // by the time of their row
    std::istringstream lines(ran.out);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string technique, setting, scene;
        int map = 0, shadow = 0;
        double time = 0;
        if (words >> technique >> setting >> scene >> map >> shadow >> time && technique == "Pyramid") sizes[time] = map;
    }
    ASSERT_EQ(sizes.size(), 3) << "256, 512 and 1024 are measured:\n" << ran.out;
    const auto picked = std::ranges::find_if(
        sizes, [&](const auto& row) { return ran.out.find(" --map-size " + std::to_string(row.second) + " ") != std::string::npos; });
    ASSERT_NE(picked, sizes.end()) << ran.out;
    EXPECT_LE(picked->first, 1.26 * sizes.begin()->first) << ran.out;
    EXPECT_NE(ran.out.find(" of no diffusion's"), std::string::npos) << "Lambert is measured beside it:\n" << ran.out;
    EXPECT_EQ(ran.out.find("-t Lambert"), std::string::npos) << "and not chosen";
    EXPECT_EQ(ran.out.find("spread: Lambert"), std::string::npos) << "nor as good:\n" << ran.out;
}

TEST(Bench, keeps_its_scenes_where_it_is_told) {
    const Ran ran = tegument(tiny({"--technique", "Lambert", "--csv", (scratch() / "r.csv").string()}));
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_TRUE(fs::exists(scratch() / "scenes" / "sphere-5-40x40.json"));
    EXPECT_TRUE(fs::exists(scratch() / "r.csv"));
}

/// A matplotlib that cannot be imported stands before the real one.
TEST(Bench, without_matplotlib_the_results_stand_and_the_plots_do_not) {
    const fs::path cache = scratch() / "cache";
    fs::create_directories(cache / "tools" / "flip");
    ASSERT_TRUE(fs::exists(write("cache/tools/flip/matplotlib.py", "raise ImportError('none here')\n")));
    const fs::path plots = scratch() / "plots";
    const Ran ran = tegument(tiny({"--technique", "Lambert", "--plot", plots.string()}), {{"TEGUMENT_CACHE", cache.string()}});
    EXPECT_EQ(ran.code, 3);
    EXPECT_NE(ran.err.find("TG8078"), std::string::npos) << ran.err;
    EXPECT_NE(ran.out.find("Lambert"), std::string::npos) << "the table is printed first";
    EXPECT_TRUE(fs::exists(plots / "pareto.json"));
}

TEST(Bench, turns_results_into_tables_without_a_device) {
    expectRefused({"bench", "--markdown", write("empty.json", "{}")}, "TG8076");
}

TEST(BenchStability, refuses_a_part_that_does_not_exist) {
    const Ran ran = tegument({"bench", "--stability", "--part", "shadows"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.err.find("TG8080"), std::string::npos) << ran.err;
    EXPECT_EQ(tegument({"bench", "--part", "shadow"}).code, 2) << "without --stability";
}

TEST(BenchStability, refuses_a_module_that_no_part_knows) {
    const Ran ran = tegument({"bench", "--stability", "--part", "shadow", "--module", "Nothing"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.err.find("TG8081"), std::string::npos) << ran.err;
}

TEST(BenchStability, prints_its_figures_as_json_and_nothing_else) {
    const Ran ran = tegument({"bench", "--stability", "--part", "roughness", "--module", "Beckmann", "--json", "-"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto report = ran.json();
    ASSERT_TRUE(report.is_object()) << ran.out;
    EXPECT_TRUE(report["pass"]);
    ASSERT_EQ(report["rows"].size(), 2);
    EXPECT_EQ(report["rows"][0]["module"], "Beckmann");
    EXPECT_EQ(report["rows"][0]["not_finite"], 0);
}

TEST(BenchStability, ends_with_1_where_an_effect_gives_what_is_no_number) {
    const Ran ran = tegument({"bench", "--stability", "--part", "finite", "--map-size", "16", "--catalogue", faultyEffects()});
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_NE(ran.out.find("FAIL"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("picture (0, 0) is inf"), std::string::npos) << ran.out;
}

TEST(VerifyProgram, a_folder_without_effects_is_refused) {
    const Ran ran = tegument({"verify", "--effects", (scratch() / "other").string()});
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_NE(ran.err.find("error TG8060"), std::string::npos) << ran.err;
}

} // namespace tegument::test
