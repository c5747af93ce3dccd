// Pictures to be looked at: samples, sizes, formats, turntables, presets, the list.
#include "tests/cli/picture.h"
#include "tests/cli/program.h"

#include "host/scene/presets.h"
#include "host/support/file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace tegument::test;
namespace fs = std::filesystem;

namespace {

Ran renderLitBall(const std::string& file, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"render", "effects/Specular.fx", "-w", ballWorkspace(), "--size", "96", "-o", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return tegument::test::tegument(arguments);
}

std::string bytesOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Mean of the absolute differences of the first three channels, of 0..1.
double apart(const std::string& a, const std::string& b) {
    const auto first = tegument::loadImage(a);
    const auto second = tegument::loadImage(b);
    EXPECT_TRUE(first && second) << a << " " << b;
    if (!first || !second || first->width != second->width || first->height != second->height) return 1e9;
    double sum = 0;
    for (int y = 0; y < first->height; ++y)
        for (int x = 0; x < first->width; ++x)
            for (int c = 0; c < 3; ++c)
                sum += std::abs(static_cast<double>(first->at(x, y, c)) - static_cast<double>(second->at(x, y, c)));
    return sum / (3.0 * first->width * first->height);
}

} // namespace

TEST(Look, a_picture_has_four_samples_a_pixel_unless_another_number_is_asked_for) {
    ASSERT_EQ(renderLitBall(out("usual.exr")).code, 0);
    ASSERT_EQ(renderLitBall(out("four.exr"), {"--samples", "4"}).code, 0);
    ASSERT_EQ(renderLitBall(out("one.exr"), {"--samples", "1"}).code, 0);
    EXPECT_EQ(apart(out("usual.exr"), out("four.exr")), 0);
    EXPECT_GT(apart(out("usual.exr"), out("one.exr")), 0);
}

TEST(Look, a_mesh_that_the_technique_does_not_draw_is_told) {
    const std::string effect =
        write("no_mesh.fx", "float4x4 gWorldViewProjection : WORLDVIEWPROJECTION;\n"
                            "float4 QuadVS(float2 p : POSITION) : SV_Position { return float4(p, 0, 1); }\n"
                            "float4 MeshVS(float4 p : POSITION) : SV_Position { return mul(p, gWorldViewProjection); }\n"
                            "float4 PS() : SV_Target0 { return 1; }\n"
                            "technique Whole { pass P < string Script = \"Draw=Buffer;\"; > "
                            "{ VertexShader = compile vs_3_0 QuadVS(); PixelShader = compile ps_3_0 PS(); } }\n"
                            "technique Meshed { pass P { VertexShader = compile vs_3_0 MeshVS(); PixelShader = compile ps_3_0 PS(); } }\n");
    const auto drawn = [&](const std::string& technique, std::vector<std::string> more) {
        std::vector<std::string> arguments = {"render", effect, "-t", technique, "--size", "16", "-o", out("no_mesh.png")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return tegument::test::tegument(arguments);
    };
    expectSaid(drawn("Whole", {"-m", ballMesh()}), 0, {"TG8054", ballMesh(), "another technique draws one"});
    EXPECT_EQ(drawn("Whole", {}).err.find("TG8054"), std::string::npos);
    EXPECT_EQ(drawn("Meshed", {"-m", ballMesh()}).err.find("TG8054"), std::string::npos);
}

TEST(Look, a_wide_picture_shows_all_that_a_square_one_shows_but_keeps_the_width_of_a_workspace_that_names_no_size) {
    const auto drawn = [](const std::vector<std::string>& scene, const std::string& size, const std::string& fit) {
        const std::string file = out("fit" + fit + size + ".exr");
        std::vector<std::string> arguments = {"render", "OriginalTexture", "--size", size, "-o", file};
        arguments.insert(arguments.end(), scene.begin(), scene.end());
        if (!fit.empty()) arguments.insert(arguments.end(), {"--fit", fit});
        const Ran ran = tegument::test::tegument(arguments);
        EXPECT_EQ(ran.code, 0) << ran.err;
        return file;
    };
    const auto isTheDefault = [&](const std::string& fit, const std::vector<std::string>& scene, const std::string& size) {
        return apart(drawn(scene, size, ""), drawn(scene, size, fit)) == 0;
    };
    const std::vector<std::string> own = {"-w", ballWorkspace()};
    EXPECT_TRUE(isTheDefault("width", own, "96x48"));
    EXPECT_FALSE(isTheDefault("both", own, "96x48"));
    std::ifstream file(ballWorkspace());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::vector<std::string> sized = {"-w", write("sized.json", R"({"size": [64, 64], )" + text.substr(1))};
    EXPECT_TRUE(isTheDefault("both", sized, "96x48"));
    EXPECT_FALSE(isTheDefault("width", sized, "96x48"));
    EXPECT_TRUE(isTheDefault("width", sized, "48") && isTheDefault("width", sized, "48x64")) << "as it was";
    if (!fs::exists(tegument::cacheFolder() / "human/human.glb")) GTEST_SKIP() << "no default head: tegument prep human";
    for (const std::vector<std::string>& ours : {std::vector<std::string>{}, {"-w", "human_front"}}) {
        EXPECT_TRUE(isTheDefault("both", ours, "96x48")) << "scalp and chin are in the picture";
        EXPECT_FALSE(isTheDefault("width", ours, "96x48"));
        EXPECT_TRUE(isTheDefault("width", ours, "48")) << "as it was";
    }
}

TEST(Look, a_technique_that_cannot_have_several_samples_is_drawn_with_one_unless_they_are_asked_for) {
    const std::string effect = write("effects/Mixed.fx", R"(
#ifndef FX_ENTRY
#endif
float4x4 gView : WORLDVIEWPROJECTION;
Texture2D gOwnMap : RENDERCOLORTARGET < string Format = "A8R8G8B8"; >;
float gScript : STANDARDSGLOBAL < string Script = "Technique=Mixed;"; >;
float4 VS(float3 position : POSITION) : SV_Position { return mul(float4(position, 1.0), gView); }
float4 PS() : SV_Target0 { return float4(1.0, 0.5, 0.25, 1.0); }
technique Mixed < string Script = "RenderColorTarget0=gOwnMap; RenderDepthStencilTarget=; ClearSetColor=gClear; Clear=Color; Pass=Draw; RenderColorTarget0=; Pass=Draw;"; >
{
    pass Draw < string Script = "Draw=Geometry;"; >
    {
        VertexShader = compile vs_3_0 VS();
        PixelShader = compile ps_3_0 PS();
        ZEnable = TRUE;
        ZWriteEnable = TRUE;
    }
}
float4 gClear = { 0.0, 0.0, 0.0, 1.0 };
)");
    const std::vector<std::string> base = {"render", effect, "-w", ballWorkspace(), "--size", "32", "--json", "-o", out("mixed.png")};
    const Ran usual = tegument::test::tegument(base);
    ASSERT_EQ(usual.code, 0) << usual.err;
    EXPECT_EQ(usual.json()["samples"], 1);
    auto asked = base;
    asked.insert(asked.end(), {"--samples", "4"});
    const Ran refused = tegument::test::tegument(asked);
    EXPECT_EQ(refused.code, 1);
    EXPECT_NE((refused.err + refused.out).find("TG4039"), std::string::npos) << refused.err;
}

TEST(Look, fur_has_no_pixel_that_is_not_a_number) {
    const Ran ran = tegument::test::tegument(
        {"render", "effects/Fur.fx", "--mesh", ballMesh(), "--size", "200", "--set", "gFurKajiyaKay=1", "-o", out("fur.exr")});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto image = tegument::loadImage(out("fur.exr"));
    ASSERT_TRUE(image);
    for (const float value : image->pixels)
        ASSERT_TRUE(std::isfinite(value)) << "black and white dots at the outline";
}

TEST(Look, one_number_is_the_size_of_a_square) {
    ASSERT_EQ(renderLitBall(out("square.png")).code, 0);
    const auto image = tegument::loadImage(out("square.png"));
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 96);
    EXPECT_EQ(image->height, 96);
    for (const char* size : {"96x", "x96", "0", "-5", "96 96", "96x96x3"}) {
        const Ran refused = renderLitBall(out("refused.png"), {"--size", size});
        EXPECT_EQ(refused.code, 2) << size;
        EXPECT_FALSE(fs::exists(out("refused.png"))) << size;
    }
}

TEST(Look, a_jpeg_shows_what_the_png_does) {
    ASSERT_EQ(renderLitBall(out("ball.png")).code, 0);
    for (const char* name : {"ball.jpg", "ball.JPEG"}) {
        const Ran ran = renderLitBall(out(name));
        ASSERT_EQ(ran.code, 0) << ran.err;
        EXPECT_EQ(bytesOf(out(name)).substr(0, 2), "\xff\xd8");
        EXPECT_LT(apart(out(name), out("ball.png")), 0.01) << "quality 92 moves no value by more than a hundredth, on the mean";
    }
    EXPECT_NE(bytesOf(out("ball.jpg")).find("technique: Specular"), std::string::npos) << "its metadata, as a comment";
}

TEST(Look, a_turntable_is_a_file_for_each_picture_and_begins_with_the_scene_as_it_stands) {
    const Ran ran = renderLitBall(out("turn.exr"), {"--turntable", "4", "--json", "--samples", "1"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    ASSERT_EQ(ran.json()["files"].size(), 4U) << ran.out;
    ASSERT_EQ(renderLitBall(out("still.exr"), {"--samples", "1"}).code, 0);
    EXPECT_LT(apart(out("turn-001.exr"), out("still.exr")), 1e-5) << "positions are brought into the world first, and rounded there";
    EXPECT_LT(apart(out("turn-003.exr"), out("still.exr")), 1e-5) << "its bumps come twice in a turn";
    for (const char* aside : {"turn-002.exr", "turn-004.exr"})
        EXPECT_GT(apart(out(aside), out("still.exr")), 1e-4) << "and are elsewhere after a quarter";
}

TEST(Look, a_turntable_is_one_animation_where_the_name_ends_in_webp) {
    const Ran ran = renderLitBall(out("turn.webp"), {"--turntable", "5"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const std::string bytes = bytesOf(out("turn.webp"));
    EXPECT_EQ(bytes.substr(0, 4) + bytes.substr(8, 4), "RIFFWEBP");
    std::size_t frames = 0;
    for (std::size_t at = bytes.find("ANMF"); at != std::string::npos; at = bytes.find("ANMF", at + 4))
        ++frames;
    EXPECT_EQ(frames, 5U);
    EXPECT_NE(ran.out.find("wrote " + out("turn.webp")), std::string::npos) << ran.out;
}

TEST(Look, what_a_turntable_cannot_be_is_refused_before_work) {
    EXPECT_EQ(renderLitBall(out("one.webp")).code, 2) << "an animation of one picture";
    EXPECT_EQ(renderLitBall(out("turn.gif"), {"--turntable", "4"}).code, 2);
    EXPECT_EQ(renderLitBall(out("turn.avi"), {"--turntable", "4"}).code, 2);
    EXPECT_EQ(renderLitBall(out("one.mp4")).code, 2);
    EXPECT_EQ(renderLitBall(out("turn.png"), {"--turntable", "1"}).code, 2);
    EXPECT_EQ(renderLitBall(out("turn.png"), {"--turntable", "4", "--dump", "all"}).code, 2);
    EXPECT_EQ(renderLitBall(out("turn.png"), {"--turntable", "4", "--frames", "9"}).code, 2);
    EXPECT_FALSE(fs::exists(out("turn-001.png")));
}

TEST(Look, a_preset_is_its_values_and_a_set_wins_over_it) {
    const std::vector<std::string> oily = {"--preset", "OILY"};
    const auto render = [](const std::string& name, std::vector<std::string> more) {
        std::vector<std::string> arguments = {"render", "effects/Main.fx", "-w", ballWorkspace(), "--size", "48", "--map-size", "64",
                                              "-o",     out(name)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Ran ran = tegument::test::tegument(arguments);
        EXPECT_EQ(ran.code, 0) << ran.err;
    };
    const auto presets = tegument::loadPresets("effects/Main.fx");
    ASSERT_TRUE(presets);
    std::vector<std::string> sets;
    for (const tegument::Preset& preset : *presets)
        if (preset.name == "oily")
            for (const auto& [name, value] : preset.parameters)
                sets.insert(sets.end(), {"-s", fmt::format("{}={}", name, value.front())});
    ASSERT_GE(sets.size(), 4U);
    render("preset.exr", oily);
    render("sets.exr", sets);
    render("plain.exr", {});
    EXPECT_EQ(apart(out("preset.exr"), out("sets.exr")), 0);
    EXPECT_GT(apart(out("preset.exr"), out("plain.exr")), 1e-4);
    std::vector<std::string> back = {"-s", "gRoughness=0.3", "-s", "gSpecularIntensity=1", "--preset", "oily"};
    render("back.exr", back);
    EXPECT_EQ(apart(out("back.exr"), out("plain.exr")), 0) << "these are the defaults";
}

TEST(Look, a_preset_that_does_not_exist_is_refused_with_those_that_do) {
    const std::vector<std::string> base = {"render", "effects/Main.fx", "-w", ballWorkspace(), "-o", out("none.png"), "--preset"};
    auto near = base;
    near.emplace_back("oilly");
    const Ran meant = tegument::test::tegument(near);
    EXPECT_EQ(meant.code, 2);
    for (const char* text : {"TG8043", "did you mean 'oily'?"})
        EXPECT_NE(meant.err.find(text), std::string::npos) << meant.err;
    auto far = base;
    far.emplace_back("velvet");
    EXPECT_NE(tegument::test::tegument(far).err.find("it has dry, oily, old"), std::string::npos);
    const Ran none = tegument::test::tegument({"render", "effects/Beckmann.fx", "--preset", "dry", "-o", out("none.png")});
    EXPECT_NE(none.err.find("Beckmann.presets.json"), std::string::npos) << none.err;
}

TEST(Look, a_preset_that_its_effect_cannot_take_is_an_error_with_its_place) {
    const std::string effect = write("effects/Preset.fx", "float gA = 1;\ntechnique T { pass P { } }\n");
    for (const char* parameters : {"{ \"gB\": 1 }", "{ \"gA\": [1, 2] }"}) {
        static_cast<void>(write("effects/Preset.presets.json", fmt::format("{{\n \"mine\": {{ \"parameters\": {} }} }}", parameters)));
        const Ran ran = tegument::test::tegument({"render", effect, "--preset", "mine", "-o", out("none.png")});
        EXPECT_EQ(ran.code, 1) << ran.err;
        for (const char* text : {"TG8044", "Preset.presets.json(2,", "mine"})
            EXPECT_NE(ran.err.find(text), std::string::npos) << text << " in " << ran.err;
    }
}

TEST(Look, the_list_names_what_there_is_and_the_command_that_brings_what_is_not) {
    const std::map<std::string, std::string> bare = {{"TEGUMENT_CACHE", (scratch() / "nothing").string()}};
    const Ran ran = tegument::test::tegument({"list", "--json"}, bare);
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto json = ran.json();
    const auto named = [&](const char* kind, const std::string& name) {
        for (const auto& row : json[kind])
            if (row["name"] == name) return row;
        ADD_FAILURE() << "no " << name << " among " << kind;
        return nlohmann::json();
    };
    const auto mainRow = named("effects", "Main");
    EXPECT_EQ(mainRow["techniques"].front(), "DEonLuebke") << "the one that is drawn when none is named";
    EXPECT_EQ(mainRow["presets"].size(), 9U) << "three looks, six skins";
    EXPECT_EQ(named("effects", "Separable")["techniques"].size(), 4U);
    EXPECT_EQ(named("workspaces", "human")["ready"], false);
    EXPECT_EQ(named("workspaces", "human")["command"], "tegument prep human");
    EXPECT_EQ(named("workspaces", "bunny")["command"], "tegument prep bunny");
    const Ran text = tegument::test::tegument({"list"}, bare);
    for (const char* part : {"Main", "DEonLuebke", "oily", "human.glb", "tegument prep human", "tegument prep bunny"})
        EXPECT_NE(text.out.find(part), std::string::npos) << part << " in\n" << text.out;
    std::istringstream lines(text.out);
    for (std::string line; std::getline(lines, line);)
        EXPECT_LE(line.size(), 100U) << line;
    auto without = bare;
    without["TEGUMENT_DATA"] = "";
    EXPECT_EQ(tegument::test::tegument({"list"}, without).out.find("lps_head"), std::string::npos) << "no command brings it";
}

TEST(Look, a_value_that_the_technique_does_not_read_is_warned_of) {
    const std::string effect =
        write("unread.fx", "float4 gBoth = 1; float4 gOne = 1; float4 gNone = 1; float gLoops = 1; Texture2D gMap;\n"
                           "float4 ofOne() { return gOne; }\n"
                           "float4 VS(float4 p : POSITION) : SV_Position { return p; }\n"
                           "float4 PA() : SV_Target0 { return gBoth; }\n"
                           "float4 PB() : SV_Target0 { return gBoth + ofOne(); }\n"
                           "float4 PC() : SV_Target0 { return gBoth + gMap.Load(int3(0, 0, 0)); }\n"
                           "#define T(N) technique10 N { pass P { SetVertexShader(CompileShader(vs_4_0, VS())); "
                           "SetPixelShader(CompileShader(ps_4_0, P##N())); } }\nT(A) T(B) T(C)\n"
                           "technique10 D < string Script = \"LoopByCount=gLoops; Pass=P; LoopEnd;\"; > { pass P { "
                           "SetVertexShader(CompileShader(vs_4_0, VS())); SetPixelShader(CompileShader(ps_4_0, PA())); } }\n");
    const std::string map = write("unread.ppm", "no picture");
    const auto said = [&](const std::string& technique, const std::string& set) {
        const Ran ran = tegument::test::tegument(
            {"render", effect, "-t", technique, "-m", ballMesh(), "--size", "16", "--set", set, "-o", out("unread.png")});
        EXPECT_EQ(ran.code, 0) << ran.err;
        return ran.err;
    };
    EXPECT_NE(said("A", "gOne=0,0,0,0").find("warning TG8029: --set gOne=0,0,0,0 changes nothing: A does not read gOne; these do: -t B\n"),
              std::string::npos);
    EXPECT_NE(said("B", "gNone=0,0,0,0").find("B does not read gNone; no technique of unread.fx does"), std::string::npos);
    EXPECT_NE(said("A", "gMap=" + map).find("A does not read gMap; these do: -t C\n"), std::string::npos);
    EXPECT_NE(said("A", "gLoops=2").find("A does not read gLoops; these do: -t D\n"), std::string::npos);
    for (const auto& [technique, set] : {std::pair{"A", "gBoth=0,0,0,0"}, {"B", "gOne=0,0,0,0"}, {"D", "gLoops=2"}})
        EXPECT_EQ(said(technique, set).find("TG8029"), std::string::npos) << technique << " " << set;
    const Ran pyramid = tegument::test::tegument({"render", "Pyramid", "-t", "Pyramid", "-m", ballMesh(), "--size", "16", "--map-size",
                                                  "64", "--set", "gTransmission=0.5", "--set", "gRoughness=0.2", "-o", out("unread.png")});
    EXPECT_NE(pyramid.err.find("Pyramid does not read gTransmission"), std::string::npos) << pyramid.err;
    EXPECT_EQ(pyramid.err.find("gRoughness"), std::string::npos) << pyramid.err;
}

TEST(Look, a_value_beyond_its_range_is_blamed_on_where_it_was_given) {
    const Ran set = renderLitBall(out("range.png"), {"--set", "gRoughness=9"});
    EXPECT_EQ(set.code, 0);
    EXPECT_NE(set.err.find("warning TG4012: gRoughness is set to 9"), std::string::npos) << set.err;
    EXPECT_EQ(set.err.find("specular.fxh"), std::string::npos) << "the effect is not at fault: " << set.err;
}
