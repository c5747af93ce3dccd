// Foreign effects as a user draws them: every one of tests/adopt shows something, and what does not is said.

#include "tests/cli/picture.h"
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <tuple>

#include <cstdlib>
#include <filesystem>
#include <sys/wait.h>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

TEST(Survey, draws_every_effect_written_in_the_manner_of_another_host) {
    const Ran ran = tegument({"survey", "tests/adopt/effects", "--size", "64", "--target", "none", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json report = Json::parse(ran.out);
    EXPECT_GE(report["files"].size(), 100U);
    for (const Json& file : report["files"]) {
        EXPECT_EQ(file["read"], "read") << file.dump(1);
        EXPECT_EQ(file["drawn"], "drawn") << file.dump(1);
    }
}

TEST(Survey, counts_what_is_refused_by_its_code) {
    fs::create_directories(scratch() / "survey");
    const std::string folder = write("survey/bad.fx", "technique T { pass P { NoSuchState = 1; } }");
    const Ran ran = tegument({"survey", folder.substr(0, folder.rfind('/')), "--size", "16"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.out.find("refused: TG2001"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("1  unknown render state 'NoSuchState'"), std::string::npos) << "the construct, and how often\n" << ran.out;
}

TEST(Survey, goes_on_where_a_driver_brings_the_process_down) {
    fs::create_directories(scratch() / "down");
    const std::string effect =
        write("down/plain.fx", "float4 VS(float4 p : POSITION) : POSITION { return p; }\nfloat4 PS() : COLOR { return 1; }\n"
                               "technique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }");
    const Json driver = {{"file_format_version", "1.0.0"}, {"ICD", {{"library_path", CRASHING_DRIVER}, {"api_version", "1.3.0"}}}};
    const std::string icd = write("down.json", driver.dump());
    const Ran ran =
        tegument({"survey", effect.substr(0, effect.rfind('/')), "--size", "16", "--target", "none"}, {{"VK_DRIVER_FILES", icd}});
    EXPECT_NE((ran.out + ran.err).find("TG4071"), std::string::npos) << ran.out << ran.err;
    EXPECT_NE((ran.out + ran.err).find("signal 6"), std::string::npos) << ran.out << ran.err;
}

TEST(SurveyAgainstMicrosoft, says_which_picture_is_the_same_and_how_far_off_another_is) {
    const fs::path folder = scratch() / "against";
    fs::create_directories(folder);
    for (const char* name : {"one_mat.fx", "fetches.fx", "d3d10_lambert.fx"}) // the second one: tests/d3d/foreign_test.cpp says why
        fs::copy_file(fs::path("tests/adopt/effects") / name, folder / name, fs::copy_options::overwrite_existing);
    const fs::path pictures = scratch() / "against_pictures";
    const fs::path sheet = scratch() / "against.png";
    const Ran ran = tegument({"survey", folder.string(), "--against-microsoft", "--size", "64", "--target", "none", "--json", "-o",
                              pictures.string(), "--sheet", sheet.string()});
    if (ran.err.find("TG3104") != std::string::npos) GTEST_SKIP() << ran.err;
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json files = Json::parse(ran.out)["files"]; // sorted by name
    EXPECT_EQ(files[0]["microsoft"], "not compared: its technique is not of Direct3D 9");
    EXPECT_TRUE(files[0]["error"].is_null());
    EXPECT_EQ(files[1]["microsoft"], "differs");
    EXPECT_GT(files[1]["error"].get<double>(), 0.02);
    EXPECT_EQ(files[2]["microsoft"], "equal");
    EXPECT_LT(files[2]["error"].get<double>(), 0.02);
    EXPECT_TRUE(fs::exists(pictures / "one_mat.microsoft.png"));
    const auto pairs = loadImage(sheet);
    ASSERT_TRUE(pairs);
    EXPECT_EQ(pairs->width, 6 * 64 + 5 * 4) << "three pairs";
}

TEST(SurveyAgainstMicrosoft, says_what_it_needs_and_how_to_get_it) {
    const Ran ran =
        tegument({"survey", "tests/adopt/effects", "--against-microsoft"}, {{"TEGUMENT_D3D_CLIENT", "/nowhere/d3d_client.exe"}});
    EXPECT_EQ(ran.code, 3) << ran.err;
    EXPECT_NE(ran.err.find("error TG3104: Microsoft's pictures cannot be drawn: "), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("./bootstrap test"), std::string::npos) << ran.err;
    EXPECT_EQ(ran.out, "");
}

TEST(Survey, has_an_example_for_continuous_integration_that_runs) {
    const std::string run = std::string("TEGUMENT=") + TEGUMENT_PROGRAM + " sh docs/samples/ci/check-effects.sh ";
    EXPECT_EQ(std::system((run + "tests/adopt/effects >/dev/null 2>&1").c_str()), 0);
    fs::create_directories(scratch() / "ci");
    const std::string bad = write("ci/bad.fx", "technique T { pass P { NoSuchState = 1; } }");
    const auto codeOf = [](const std::string& line) { return WEXITSTATUS(std::system((line + " >/dev/null 2>&1").c_str())); };
    EXPECT_EQ(codeOf(run + bad.substr(0, bad.rfind('/'))), 1);
    EXPECT_EQ(codeOf("TEGUMENT=" + write("ci/lacks.sh", "#!/bin/sh\nexit 3\n") +
                     " && chmod +x $TEGUMENT && export TEGUMENT && sh docs/samples/ci/check-effects.sh tests/adopt/effects"),
              3);
}

std::string flat(const std::string& name, const std::string& colour) {
    return write(name, "float4 VS(float4 p : POSITION) : POSITION { return p; }\nfloat4 PS() : COLOR { return " + colour +
                           "; }\ntechnique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }\n");
}

TEST(ForeignPictures, of_one_colour_are_said) {
    const Ran black = tegument({"render", flat("black.fx", "0"), "--size", "16", "-o", (scratch() / "black.png").string()});
    EXPECT_EQ(black.code, 0) << black.err;
    EXPECT_NE(black.err.find("TG4070: the picture is black"), std::string::npos) << black.err;
    const Ran red = tegument({"render", flat("red.fx", "float4(1, 0, 0, 1)"), "--size", "16", "-o", (scratch() / "red.png").string()});
    EXPECT_NE(red.err.find("the picture is one colour, (1.00, 0.00, 0.00)"), std::string::npos) << red.err;
}

TEST(ForeignPictures, are_classed_by_what_they_show) {
    const fs::path folder = scratch() / "classes";
    fs::create_directories(folder);
    flat("classes/nothing.fx", "0");
    flat("classes/one.fx", "float4(1, 0, 0, 1)");
    std::ignore =
        write("classes/same.fx", "texture B : COLOR; sampler S { Texture = B; };\n"
                                 "void VS(uint i : SV_VertexID, out float4 p : SV_Position, out float2 u : TEXCOORD)\n"
                                 "{ u = float2(i == 2 ? 2 : 0, i == 1 ? 2 : 0); p = float4(u * float2(2, -2) + float2(-1, 1), 0, 1); }\n"
                                 "float4 PS(float4 p : SV_Position, float2 u : TEXCOORD) : SV_Target { return tex2D(S, u); }\n"
                                 "technique T { pass { VertexShader = VS; PixelShader = PS; } }\n");
    const fs::path sheet = scratch() / "classes.png";
    const Ran ran =
        tegument({"survey", folder.string(), "--size", "32", "-o", (scratch() / "classed").string(), "--sheet", sheet.string(), "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json json = Json::parse(ran.out);
    std::vector<std::string> classes;
    for (const Json& file : json["files"])
        classes.push_back(file["picture"]);
    EXPECT_EQ(classes, (std::vector<std::string>{"nothing", "one colour", "unchanged"})) << ran.out;
    EXPECT_TRUE(fs::exists(sheet));
}

TEST(ForeignPictures, are_given_to_effects_that_change_one) {
    const Ran ran =
        tegument({"render", flat("deaf.fx", "0"), "--picture-in", "docs/images/coats.jpg", "-o", (scratch() / "deaf.png").string()});
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_NE(ran.err.find("TG8082"), std::string::npos) << ran.err;
}

TEST(ForeignPictures, take_a_stand_in_where_a_file_is_of_a_kind_that_only_its_host_reads) {
    fs::create_directories(scratch() / "Maps");
    ASSERT_FALSE(write("Maps/Brick.TGA", "no picture").empty());
    const std::string file =
        write("brick.fx", "texture t < string ResourceName = \"maps\\\\brick.tga\"; >; sampler2D s = sampler_state { Texture = <t>; };\n"
                          "float4 PS(float2 uv : TEXCOORD0) : COLOR { return tex2D(s, uv); }\n"
                          "technique T { pass P { ZEnable = FALSE; PixelShader = compile ps_2_0 PS(); } }\n");
    const Ran ran = tegument({"render", file, "--size", "16", "-o", (scratch() / "brick.png").string()});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.err.find("warning TG4031: maps\\brick.tga, the texture of t"), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.find("TG4070"), std::string::npos) << "a checker is not one colour\n" << ran.err;
}

TEST(ForeignPictures, read_what_was_there_before_where_a_pass_draws_into_what_it_samples) {
    const std::string pass = "{ ZEnable = FALSE; VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 ";
    const std::string file =
        write("sums.fx",
              "texture t : RENDERCOLORTARGET < string Format = \"A16B16G16R16F\"; >;\nsampler2D s = sampler_state { Texture = <t>; };\n"
              "void VS(float4 p : POSITION, float2 uv : TEXCOORD0, out float4 o : POSITION, out float2 u : TEXCOORD0)"
              " { o = p; u = uv; }\n"
              "float4 More(float2 uv : TEXCOORD0) : COLOR { return tex2D(s, uv) + 0.25; }\n"
              "float4 Show(float2 uv : TEXCOORD0) : COLOR { return tex2D(s, uv); }\n"
              "technique T < string Script = \"RenderColorTarget0=t; Clear=Color; Pass=A; Pass=B; Pass=C; RenderColorTarget0=;"
              " Pass=D;\"; > { pass A " +
                  pass + "More(); } pass B " + pass + "More(); } pass C " + pass + "More(); } pass D " + pass + "Show(); } }");
    const Ran ran = tegument({"render", file, "--size", "16", "-o", (scratch() / "sums.png").string()});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.err.find("warning TG4024: pass A samples t while drawing into it: it reads a copy"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("the picture is one colour, (0.75, 0.75, 0.75)"), std::string::npos) << ran.err;
}

TEST(ForeignPictures, come_with_a_line_for_each_parameter) {
    const std::string file =
        write("bound.fx", "float4x4 strange; float4 tint = { 1, 0, 0, 1 };\n"
                          "float4 VS(float4 p : POSITION) : POSITION { return mul(p, strange); }\nfloat4 PS() : COLOR { return tint; }\n"
                          "technique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }\n");
    const Ran ran = tegument(
        {"render", file, "--size", "16", "-o", (scratch() / "bound.png").string(), "--bind", "strange=WORLDVIEWPROJECTION", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json report = Json::parse(ran.out);
    EXPECT_EQ(report["bindings"][0]["got"], "WORLDVIEWPROJECTION");
    EXPECT_EQ(report["bindings"][0]["by"], "--bind");
    EXPECT_EQ(report["bindings"][1]["got"], "its default");
    EXPECT_FALSE(report.contains("picture")) << "a red disc on black";
}

TEST(ForeignPictures, with_an_array_of_textures_are_refused_with_its_line) {
    const std::string file = write("layers.fx", "float4 tint;\nTexture2D gLayers[2];\nSamplerState s;\n"
                                                "float4 VS(float4 p : POSITION) : SV_Position { return p; }\n"
                                                "float4 PS() : SV_Target { return gLayers[1].Sample(s, 0); }\n"
                                                "technique11 T { pass P { SetVertexShader(CompileShader(vs_5_0, VS())); "
                                                "SetPixelShader(CompileShader(ps_5_0, PS())); } }\n");
    const Ran ran = tegument({"render", file, "--size", "16", "-o", (scratch() / "layers.png").string()});
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_NE(ran.err.find("layers.fx(2,"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("TG3006"), std::string::npos) << ran.err;
}

TEST(ForeignPictures, that_only_dxc_compiles_say_so_where_it_is_not) {
    const std::string file = write("pair.fx", "texture t; sampler2D s = sampler_state { Texture = <t>; };\n"
                                              "float4 PS(float2 u : TEXCOORD0) : COLOR { return tex2D(s, u); }\n"
                                              "technique T { pass P { ZEnable = FALSE; PixelShader = compile ps_2_0 PS(); } }\n");
    const Ran ran = tegument({"render", file, "--compiler", "glslang", "--size", "16", "-o", (scratch() / "pair.png").string()},
                             {{"TEGUMENT_DXC", "/nonexistent"}});
    EXPECT_EQ(ran.code, 3) << ran.err;
    EXPECT_NE(ran.err.find("./bootstrap build fetches it"), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.find("try the other one"), std::string::npos) << "there is no other one\n" << ran.err;
}

TEST(ForeignPictures, of_functions_without_a_technique_say_what_is_missing) {
    const std::string file = write("functions.hlsl", "float4 P() : COLOR { return 1; }\n");
    const Ran ran = tegument({"render", file, "--size", "16", "-o", (scratch() / "functions.png").string()});
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_NE(ran.err.find("TG4001"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("technique T { pass P"), std::string::npos) << "not what an effect of this host needs\n" << ran.err;
}

TEST(ForeignPictures, with_several_samples_do_without_anisotropy_on_a_software_device) {
    const auto picture = [](const std::string& name, const std::string& count) {
        const std::string file =
            write(name + ".fx",
                  "float4x4 m : WORLDVIEWPROJECTION; Texture2D t;\nSamplerState s { Filter = ANISOTROPIC; MaxAnisotropy = " + count +
                      "; };\nstruct V { float4 p : SV_Position; float2 t : TEXCOORD; };\n"
                      "V VS(float4 p : POSITION, float2 t : TEXCOORD) { V o; o.p = mul(p, m); o.t = 9 * t; return o; }\n"
                      "float4 PS(V i) : SV_Target { return t.Sample(s, i.t); }\n"
                      "technique11 T { pass P { SetVertexShader(CompileShader(vs_5_0, VS())); "
                      "SetPixelShader(CompileShader(ps_5_0, PS())); } }\n");
        return render(name, {file, "--size", "48", "--samples", "4"});
    };
    const Picture without = picture("once", "1");
    if (without.report["device"].dump().find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << "no software device (mesa-vulkan-drivers; ./bootstrap test brings it): only there anisotropy is left out";
    EXPECT_EQ(picture("often", "8").image.pixels, without.image.pixels) << "Mesa takes ten seconds and more for it";
}

struct Lookup {
    std::string name;
    std::string filters;
    std::string code; // of the pixel shader
};
void PrintTo(const Lookup& tested, std::ostream* out) {
    *out << tested.code;
}
class AnisotropicLookups : public testing::TestWithParam<Lookup> {};

// Mesa's software device died of them where only one of the two filters is POINT.
TEST_P(AnisotropicLookups, are_drawn) {
    const std::string file =
        write("look-up.fx", "float4x4 m : WORLDVIEWPROJECTION; texture t; sampler s = sampler_state { Texture = <t>; MaxAnisotropy = 4; " +
                                GetParam().filters +
                                " };\nstruct V { float4 p : POSITION; float2 t : TEXCOORD0; };\n"
                                "V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V o; o.p = mul(p, m); o.t = t; return o; }\n"
                                "float4 PS(float2 t : TEXCOORD0) : COLOR { " +
                                GetParam().code +
                                " }\n"
                                "technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }\n");
    const Ran ran = tegument({"render", file, "--size", "32", "--samples", "1", "-o", (scratch() / "look-up.png").string()});
    EXPECT_EQ(ran.code, 0) << ran.err;
}

INSTANTIATE_TEST_SUITE_P(
    OfASoftwareDevice, AnisotropicLookups,
    testing::Values(Lookup{"in_a_loop", "MagFilter = Anisotropic; MinFilter = Point;",
                           "float2 at = t; float h = 0; for (float b = 1; h < b; b -= 0.1) { at += 0.05; h = tex2Dlod(s, float4(at, 0, "
                           "0)).r; } return h;"},
                    Lookup{"with_a_level", "MagFilter = Point; MinFilter = Anisotropic;", "return tex2Dlod(s, float4(t, 0, 1));"},
                    Lookup{"with_a_bias", "MinFilter = Point; MagFilter = Anisotropic;", "return tex2Dbias(s, float4(t, 0, 1));"}),
    [](const testing::TestParamInfo<Lookup>& tested) { return tested.param.name; });

// Who may read everything cannot read this one either: its name is longer than the system's longest.
TEST(Survey, a_folder_that_cannot_be_read_is_told_and_the_others_are_drawn) {
    const fs::path before = fs::current_path();
    static_cast<void>(write("deep/good.fx", "technique T { pass P { NoSuchState = 1; } }"));
    fs::current_path(scratch() / "deep");
    const fs::path name(std::string(250, 'd'));
    for (int i = 0; i < 20; ++i) {
        fs::create_directory(name);
        fs::current_path(name);
    }
    fs::current_path(before);
    const Ran ran = tegument({"survey", (scratch() / "deep").string(), "--size", "16", "--target", "none"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.err.find("warning TG8006"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("are left out"), std::string::npos) << ran.err;
    EXPECT_NE(ran.out.find("good.fx"), std::string::npos) << ran.out;
}

TEST(Survey, of_a_folder_without_effects_is_an_error) {
    fs::create_directories(scratch() / "none");
    const std::string file = write("none/luma.effect", "technique T {}");
    const Ran ran = tegument({"survey", file.substr(0, file.rfind('/'))});
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_NE(ran.err.find("TG8006"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("*.fx"), std::string::npos) << ran.err;
}

} // namespace
} // namespace tegument::test
