// Effects of other hosts, written for this test in the manner of each, become sources that DXC takes; and what their parameters get.
// Every construct that foreign effects are refused for elsewhere stands in three or more of the effects that are read, compiled and drawn.

#include "host/spirv/compile.h"
#include "host/support/file.h"
#include "meshprep/adopt/adopt.h"
#include "meshprep/adopt/bind.h"
#include "tests/adopt/support.h"
#include "tests/spirv/missing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> effects() {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator("tests/adopt/effects"))
        if (entry.path().extension() == ".fx") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

Result<Shader> compiled(const Effect& effect, const ShaderReference& shader, ShaderStage stage) {
    if (shader.obstacle) return Error{Blame::Input, {*shader.obstacle}};
    return compileShader({.code = shader.code, .file = effect.file.string(), .entry = shader.entry, .stage = stage, .language2018 = true},
                         Compiler::Dxc);
}

class ForeignEffects : public testing::TestWithParam<fs::path> {};

TEST_P(ForeignEffects, compile_in_every_pass_and_their_stages_meet) {
    if (const std::string missing = compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    const Result<Effect> effect = loadEffect(GetParam(), {.lenient = true});
    ASSERT_TRUE(effect) << format(effect.error());
    const Adoption adoption = adopted(*effect);
    for (const Technique& technique : adoption.effect.techniques)
        for (const Pass& pass : technique.passes) {
            if (pass.geometryShader || pass.hullShader || pass.domainShader || pass.streamOutput) continue; // drawing says TG4003
            if (pass.assemblyShaders > 0) continue;
            ASSERT_TRUE(pass.vertexShader) << pass.name;
            const auto vertex = compiled(adoption.effect, *pass.vertexShader, ShaderStage::Vertex);
            ASSERT_TRUE(vertex) << format(vertex.error()) << pass.vertexShader->code;
            if (!pass.pixelShader) continue;
            auto pixel = compiled(adoption.effect, *pass.pixelShader, ShaderStage::Pixel);
            ASSERT_TRUE(pixel) << format(pixel.error()) << pass.pixelShader->code;
            const auto linked = linkStages(*vertex, *pixel);
            EXPECT_TRUE(linked) << format(linked.error());
        }
}

std::string fileName(const testing::TestParamInfo<fs::path>& tested) {
    return tested.param.stem().string();
}

INSTANTIATE_TEST_SUITE_P(Files, ForeignEffects, testing::ValuesIn(effects()), fileName);

TEST(ForeignMessages, name_the_authors_line) {
    if (const std::string missing = compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    const Effect effect = adopted(foreign("float a;\n\n\nfloat4 PS() : COLOR\n{\n    return nowhere;\n}\n" + kRest)).effect;
    const auto pixel = compiled(effect, *effect.techniques[0].passes[0].pixelShader, ShaderStage::Pixel);
    ASSERT_FALSE(pixel);
    EXPECT_EQ(pixel.error().diagnostics[0].at.line, 6) << format(pixel.error());
    EXPECT_EQ(pixel.error().diagnostics[0].at.file, "main.fx");
}

TEST(ForeignMessages, say_what_no_later_model_has) {
    const Effect effect = adopted(foreign("float4 PS(float2 t : TEXCOORD0) : COLOR { return noise(t); }\n" + kRest)).effect;
    const auto obstacle = effect.techniques[0].passes[0].pixelShader->obstacle;
    ASSERT_TRUE(obstacle);
    EXPECT_EQ(obstacle->code, 3405);
    EXPECT_NE(obstacle->text.find("not in shader model 4"), std::string::npos);
}

TEST(ForeignMessages, refuse_what_dxc_does_not_survive) {
    for (const char* const body : {"VertexShader v[2] = 1; return 1;", "Nothing v[2] = 1; return 1;"}) {
        const Effect effect = adopted(foreign(fmt::format("float4 PS() : COLOR {{ {} }}\n{}", body, kRest))).effect;
        ASSERT_TRUE(effect.techniques[0].passes[0].pixelShader->obstacle) << body;
        EXPECT_EQ(effect.techniques[0].passes[0].pixelShader->obstacle->code, 3405);
        EXPECT_FALSE(effect.techniques[0].passes[0].vertexShader->obstacle) << "the other stage is respelt all the same";
    }
}

TEST(ForeignMessages, name_a_function_that_is_only_declared) {
    const Effect effect = adopted(foreign("float4 PS() : COLOR;\n" + kRest)).effect;
    ASSERT_TRUE(effect.techniques[0].passes[0].pixelShader->obstacle);
    EXPECT_EQ(effect.techniques[0].passes[0].pixelShader->obstacle->code, 3401);
}

TEST(ForeignMessages, name_a_parameter_without_a_value) {
    const Effect effect = adopted(foreign("float4 PS(uniform float k) : COLOR { return k; }\n" + kRest)).effect;
    ASSERT_TRUE(effect.techniques[0].passes[0].pixelShader->obstacle);
    EXPECT_EQ(effect.techniques[0].passes[0].pixelShader->obstacle->code, 3402);
}

TEST(ForeignMessages, name_an_output_that_no_pixel_shader_has) {
    const Effect effect = adopted(foreign("float4 PS() : TEXCOORD3 { return 1; }\n" + kRest)).effect;
    ASSERT_TRUE(effect.techniques[0].passes[0].pixelShader->obstacle);
    EXPECT_EQ(effect.techniques[0].passes[0].pixelShader->obstacle->code, 3403);
}

TEST(ForeignMessages, note_what_stands_in) {
    const Adoption adoption = adopted(foreign("technique T { pass P { } }"));
    EXPECT_TRUE(std::ranges::any_of(adoption.notes, [](const Diagnostic& note) { return note.code == 3404; }));
}

/// Samplers of both generations, each read in both ways, as fxc takes them.
TEST(ForeignSamplers, of_each_generation_are_read_by_the_functions_of_both) {
    if (const std::string missing = compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    for (const char* read : {"t.Sample(nine, u)", "t.SampleLevel(nine, u, 0)", "tex2D(nine, u)", "tex2D(eleven, u)", "t.Sample(eleven, u)",
                             "t.Sample(eleven, u) + tex2D(eleven, u)", "t.Sample(nine, u) + tex2D(nine, u)"}) {
        const Adoption adoption = adopted(
            foreign("Texture2D t; sampler nine : register(s0); SamplerState eleven { Filter = MIN_MAG_MIP_POINT; Texture = <t>; };\n"
                    "float4 VS(float4 p : POSITION, inout float2 u : TEXCOORD0) : SV_Position { return p; }\n"
                    "float4 PS(float4 p : SV_Position, float2 u : TEXCOORD0) : SV_Target { return " +
                    std::string(read) +
                    "; }\ntechnique11 T { pass P { SetVertexShader(CompileShader(vs_4_0, VS())); "
                    "SetPixelShader(CompileShader(ps_4_0, PS())); } }"));
        const auto pixel = compiled(adoption.effect, *adoption.effect.techniques[0].passes[0].pixelShader, ShaderStage::Pixel);
        EXPECT_TRUE(pixel) << read << "\n" << format(pixel.error());
    }
}

TEST(ForeignStreams, of_matrices_place_one_instance_where_it_is) {
    const auto wrapper = [](const std::string& members) {
        const Effect effect =
            adopted(foreign("float4x4 m : VIEWPROJECTION; struct I { float4 p : POSITION; " + members +
                            " };\nfloat4 VS(I i) : SV_Position { return mul(mul(i.p, m), float4x4(i.a, i.b, i.c, i.d)); }\n"
                            "float4 PS() : SV_Target { return 1; }\ntechnique11 T { pass P { SetVertexShader(CompileShader(vs_5_0, VS())); "
                            "SetPixelShader(CompileShader(ps_5_0, PS())); } }"))
                .effect;
        return effect.techniques[0].passes[0].vertexShader->code;
    };
    const std::string rows = wrapper("float4 a : WORLD0; float4 b : WORLD1; float4 c : WORLD2; float4 d : WORLD3;");
    EXPECT_NE(rows.find("tg_i.b = (float4)(float4(0, 1, 0, 0))"), std::string::npos) << rows;
    const std::string whole = wrapper("row_major float4x4 w : INSTANCE; float4 a : A; float4 b : B; float4 c : C; float4 d : D;");
    EXPECT_NE(whole.find("tg_i.w[2] = (float4)(float4(0, 0, 1, 0))"), std::string::npos) << "all zero, it drew nothing\n" << whole;
    const std::string weights = wrapper("float4x4 w : BLENDWEIGHT; float4 a : A; float4 b : B; float4 c : C; float4 d : D;");
    EXPECT_NE(weights.find("tg_i.w[3] = (float4)(float4(0, 0, 0, 1))"), std::string::npos) << "where XNA's samples have it\n" << weights;
}

TEST(ForeignPasses, without_a_matrix_cover_the_target_and_others_place_the_mesh) {
    const Effect flat = adopted(foreign("float4 PS() : COLOR { return 1; }\n" + kRest)).effect;
    EXPECT_TRUE(flat.techniques[0].passes[0].script.given);
    EXPECT_EQ(flat.techniques[0].passes[0].script.commands[0].options[0], "Buffer");
    const Effect mesh = adopted(foreign("float4x4 m : WORLDVIEWPROJECTION; float4 V(float4 p : POSITION) : POSITION { return mul(p, m); }\n"
                                        "technique T { pass P { VertexShader = compile vs_2_0 V(); } }"))
                            .effect;
    EXPECT_FALSE(mesh.techniques[0].passes[0].script.given);
    EXPECT_TRUE(mesh.techniques[0].passes[0].state.frontCounterClockwise);
}

TEST(ForeignPasses, of_this_hosts_own_effects_stay_as_they_are) {
    const Adoption own = adopted(loaded("#ifdef FX_ENTRY\n#endif\nfloat4 V(float4 p : POSITION) : SV_Position { return p; }\n"
                                        "technique11 T { pass P { SetVertexShader(CompileShader(vs_5_0, V())); } }"));
    EXPECT_FALSE(own.effect.displayColours);
    EXPECT_TRUE(own.effect.techniques[0].passes[0].vertexShader->code.empty());
}

TEST(ForeignPasses, keep_the_alpha_test_as_code) {
    const Effect effect = adopted(foreign("float4 PS() : COLOR { return 1; }\nfloat4 VS(float4 p : POSITION) : POSITION { return p; }\n"
                                          "technique T { pass P { AlphaTestEnable = TRUE; AlphaFunc = Greater; AlphaRef = 7;\n"
                                          "VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }"))
                              .effect;
    const std::string& code = effect.techniques[0].passes[0].pixelShader->code;
    EXPECT_NE(code.find("> 7)) discard;"), std::string::npos) << code;
}

TEST(ForeignPasses, blend_no_more_than_one_into_a_picture) {
    const auto saturates = [](const std::string& states, const std::string& script) {
        const Effect effect = adopted(foreign("texture R : RENDERCOLORTARGET; float4 PS() : COLOR { return 2; }\n"
                                              "float4 VS(float4 p : POSITION) : POSITION { return p; }\ntechnique T < string Script = \"" +
                                              script + "Pass=P;\"; > { pass P { " + states +
                                              " VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }"))
                                  .effect;
        return effect.techniques[0].passes[0].pixelShader->code.find("o0 = saturate(o0);") != std::string::npos;
    };
    EXPECT_TRUE(saturates("AlphaBlendEnable = TRUE;", "RenderColorTarget0=;"));
    EXPECT_FALSE(saturates("", "")) << "without blending the display does it";
    EXPECT_FALSE(saturates("AlphaBlendEnable = TRUE;", "RenderColorTarget0=R;")) << "the target has a format of its own";
}

struct NameCase {
    std::string name;
    std::string matrix; // empty: none
};
class MatrixNames : public testing::TestWithParam<NameCase> {};

TEST_P(MatrixNames, are_known_in_their_spellings) {
    EXPECT_EQ(adopt::matrixName(GetParam().name).value_or(""), GetParam().matrix) << GetParam().name;
}

INSTANTIATE_TEST_SUITE_P(Spellings, MatrixNames,
                         testing::Values(NameCase{"WorldViewProjection", "WORLDVIEWPROJECTION"},
                                         NameCase{"world_view_proj_matrix", "WORLDVIEWPROJECTION"}, NameCase{"WVP", "WORLDVIEWPROJECTION"},
                                         NameCase{"matWorldViewPrj", "WORLDVIEWPROJECTION"}, NameCase{"WorldIT", "WORLDINVERSETRANSPOSE"},
                                         NameCase{"WORLDINVERSETRANSPOSE", "WORLDINVERSETRANSPOSE"}, NameCase{"ViewInverse", "VIEWINVERSE"},
                                         NameCase{"inv_view_matrix", "VIEWINVERSE"}, NameCase{"ViewI", "VIEWINVERSE"},
                                         NameCase{"matViewProjection", "VIEWPROJECTION"}, NameCase{"InvWorldTranspose", ""},
                                         NameCase{"ModelViewProj", "WORLDVIEWPROJECTION"}, NameCase{"WorldTranspose", "WORLDTRANSPOSE"},
                                         NameCase{"Viewer", ""}, NameCase{"Worldly", ""}, NameCase{"Texture", ""}));

/// What one parameter of an effect gets.
ParameterBinding binding(const std::string& declaration, const AdoptOptions& options = {}) {
    Effect effect = foreign(declaration);
    return adopt::bindParameter(effect.parameters[0], options, 0);
}

struct BoundCase {
    std::string name;
    std::string declaration;
    std::string source;
};
void PrintTo(const BoundCase& tested, std::ostream* out) {
    *out << tested.declaration;
}
class BoundParameters : public testing::TestWithParam<BoundCase> {};

TEST_P(BoundParameters, get) {
    EXPECT_EQ(binding(GetParam().declaration).source, GetParam().source);
}

INSTANTIATE_TEST_SUITE_P(
    Declared, BoundParameters,
    testing::Values(
        BoundCase{"by_semantic", "float4x4 foo : WorldViewProj;", "WORLDVIEWPROJECTION"},
        BoundCase{"by_name", "float4x4 g_mWorldViewProjection;", "WORLDVIEWPROJECTION"},
        BoundCase{"by_address_before_name", "float4x4 View < string SasBindAddress = \"Sas.Camera.Projection\"; >;", "PROJECTION"},
        BoundCase{"the_lights_place", "float3 p : POSITION < string Object = \"PointLight0\"; >;", "POSITION of the light"},
        BoundCase{"the_cameras_place", "float3 p : POSITION < string Object = \"Camera\"; >;", "CAMERAPOSITION"},
        BoundCase{"the_eye_by_name", "float3 g_vEyePos;", "CAMERAPOSITION"},
        BoundCase{"the_way_of_light", "float3 d : DIRECTION < string Object = \"DirectionalLight0\"; >;", "LIGHTDIRECTION"},
        BoundCase{"a_direction_that_nothing_turns_round", "float3 g_LightDir;", "TOLIGHT"},
        BoundCase{"a_light_with_a_number_s_way", "float3 d : LIGHTDIR0_DIRECTION;", "LIGHTDIRECTION"},
        BoundCase{"a_light_with_a_number_s_colour", "float3 c : LIGHTDIR0_COLOR;", "white"},
        BoundCase{"a_light_with_a_number_s_place", "float3 p : LIGHTPOINT0_POSITION;", "POSITION of the light"},
        BoundCase{"a_colour_by_address", "float3 c < string SasBindAddress = \"Sas.DirectionalLight[0].Color\"; >;", "white"},
        BoundCase{"a_colour_of_a_directional_light", "float3 DirLight0DiffuseColor;", "white"},
        BoundCase{"what_the_author_gave", "float4 diffuseColor = { 1, 0, 0, 1 };", "its default"},
        BoundCase{"white", "float4 diffuseColor;", "white"}, BoundCase{"a_power", "float shininess;", "20"},
        BoundCase{"what_only_the_scene_knows", "float3 LightPosition = { 1, 2, 3 };", "POSITION of the light"},
        BoundCase{"fog_that_begins_behind_everything", "float gFogStart;", "behind everything: no fog"},
        BoundCase{"fog_that_ends_there", "float g_fFogEnd;", "behind everything: no fog"},
        BoundCase{"fog_without_density", "float FogDensity;", "zero: no fog"},
        BoundCase{"fog_that_is_no_end_but_blended", "float fogBlend;", "zero: no fog"},
        BoundCase{"fog_that_the_author_begins_at_the_eye", "float FogStart = 0;", "zero: no fog"},
        BoundCase{"a_light_that_the_host_switches_on", "bool light0Enable : LIGHTENABLE < string Object = \"Light 0\"; > = false;", "on"},
        BoundCase{"a_light_that_is_on_by_name", "bool g_bSunEnabled;", "on"},
        BoundCase{"no_light_that_only_sounds_like_it", "bool slightly;", "zero"}, BoundCase{"a_scale", "float g_fScale;", "one"},
        BoundCase{"vvvvs_size_of_the_target", "float2 R;", "VIEWPORTPIXELSIZE"}, BoundCase{"no_size_in_a_radius", "float R;", "zero"},
        BoundCase{"a_tone", "float3 _sepiaTone;", "one"}, BoundCase{"weights", "float sampleWeights[4];", "one, shared out"},
        BoundCase{"a_factor_that_its_author_left_at_zero", "float scaleFactor = 0;", "zero"},
        BoundCase{"the_eye_of_dxut", "float3 g_vEyePt;", "CAMERAPOSITION"}, BoundCase{"no_eye_in_an_option", "float3 eyeOption;", "zero"},
        BoundCase{"no_bones", "float4x4 gBones[4];", "identities: no bones"}, BoundCase{"zero", "float whatever;", "zero"},
        BoundCase{"zero_where_no_matrix_is_declared", "float World;", "zero"},
        BoundCase{"zero_where_two_numbers_are_declared", "float2 LightPosition;", "zero"},
        BoundCase{"zero_where_integers_are_declared", "int3 CameraPosition;", "zero"}),
    [](const testing::TestParamInfo<BoundCase>& tested) { return tested.param.name; });

TEST(ForeignBindings, say_their_rule) {
    EXPECT_EQ(binding("float4x4 g_mWorldViewProjection;").rule, "name");
    EXPECT_EQ(binding("float4x4 foo : WorldViewProj;").rule, "semantic WorldViewProj");
}

TEST(ForeignBindings, obey_the_command_line) {
    EXPECT_EQ(binding("float4x4 strange;", {.bind = {{"strange", "WORLDVIEWPROJECTION"}}}).source, "WORLDVIEWPROJECTION");
    EXPECT_EQ(binding("float4x4 World : WORLD;", {.bind = {{"World", "default"}}}).source, "the identity");
}

TEST(ForeignBindings, take_every_choice_that_is_offered) {
    for (const char* declaration : {"float4x4 p;", "float3 p;", "float4 p;", "float2 p;", "float p;", "int p;", "float4x4 p[4];"}) {
        const Effect effect = foreign(declaration + ("\nfloat4 PS() : COLOR { return 1; }\n" + kRest));
        for (const std::string& choice : bindChoices(effect.parameters[0]))
            EXPECT_EQ(binding(declaration, {.bind = {{"p", choice}}}).rule, "--bind") << declaration << " " << choice;
    }
}

TEST(ForeignBindings, give_textures_the_picture_that_is_asked_for) {
    const auto bound = [](const std::string& declaration, const std::string& picture) {
        const Adoption adoption = adopted(foreign(declaration +
                                                  " sampler s = sampler_state { Texture = <pic>; };\n"
                                                  "float4 PS(float2 t : TEXCOORD0) : COLOR { return tex2D(s, t); }\n" +
                                                  kRest),
                                          {.bind = {{"pic", picture}}});
        const Parameter& parameter = *adoption.effect.findParameter("pic");
        const auto found = std::ranges::find(adoption.bindings, "pic", &ParameterBinding::parameter);
        return std::vector<std::string>{parameter.annotations.string("Procedure").value_or(""), found->source, found->rule,
                                        parameter.annotations.string("ResourceName").value_or("none")};
    };
    const std::string file = "texture pic : DIFFUSE < string ResourceName = \"a.png\"; >;";
    EXPECT_EQ(bound(file, "noise"), (std::vector<std::string>{"noise", "noise", "--bind", "none"})) << "nor the file, nor the mesh's own";
    EXPECT_EQ(bound(file, "sky"), (std::vector<std::string>{"checker", "checker", "--bind names no picture of this host: 'sky'", "a.png"}));
}

TEST(ForeignBindings, follow_the_members_of_a_structure_with_an_address) {
    const Adoption adoption = adopted(foreign("struct D { float3 Color; float3 Direction; };\n"
                                              "D sun < string SasBindAddress = \"Sas.DirectionalLight[0]\"; >;\n"
                                              "float4 PS() : COLOR { return float4(sun.Color * sun.Direction, 1); }\n" +
                                              kRest));
    const auto got = [&](const std::string& name) {
        return std::ranges::find(adoption.bindings, name, &ParameterBinding::parameter)->source;
    };
    EXPECT_EQ(got("sun_Color"), "white");
    EXPECT_EQ(got("sun_Direction"), "LIGHTDIRECTION");
}

/// The semantic of `m`, which these words of a vertex shader multiply with.
std::string semanticOf(const std::string& product, const AdoptOptions& options = {}) {
    const std::string text = "float4x4 m : WORLDVIEWPROJECTION; float4x4 w : WORLD; float4x4 p : PROJECTION;\n"
                             "float4 VS(float4 v : POSITION) : POSITION { return " +
                             product +
                             "; }\nfloat4 PS() : COLOR { return 1; }\n"
                             "technique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }";
    return adopted(foreign(text), options).effect.findParameter("m")->semantic;
}

TEST(ForeignMatrices, are_transposed_where_they_stand_before_what_they_project) {
    EXPECT_EQ(semanticOf("mul(m, v)"), "WORLDVIEWPROJECTIONTRANSPOSE");
    EXPECT_EQ(semanticOf("mul((float4x4)m, mul(w, v))"), "WORLDVIEWPROJECTIONTRANSPOSE");
    EXPECT_EQ(semanticOf("mul(v, m)"), "WORLDVIEWPROJECTION");
    EXPECT_EQ(semanticOf("mul(w, mul(v, m))"), "WORLDVIEWPROJECTION");
}

TEST(ForeignMatrices, stay_where_the_code_has_both_orders_or_the_user_binds_them) {
    EXPECT_EQ(semanticOf("mul(m, v) + mul(v, p)"), "WORLDVIEWPROJECTION");
    EXPECT_EQ(semanticOf("mul(m, v)", {.bind = {{"m", "WORLDVIEWPROJECTION"}}}), "WORLDVIEWPROJECTION");
}

constexpr int kLeast = 3;

struct Construct {
    std::string name;
    std::string pattern; // ECMAScript
};
void PrintTo(const Construct& construct, std::ostream* out) {
    *out << construct.name;
}

/// Includes stand with the effect that they belong to: each is a text of its own here, counted once.
const std::vector<std::pair<std::string, std::string>>& texts() {
    static const auto kTexts = [] {
        std::vector<std::pair<std::string, std::string>> list;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator("tests/adopt/effects"))
            if (entry.is_regular_file()) list.emplace_back(entry.path().filename().string(), *readFile(entry.path()));
        return list;
    }();
    return kTexts;
}

class Constructs : public testing::TestWithParam<Construct> {};

TEST_P(Constructs, stand_in_three_effects_or_more) {
    const std::regex pattern(GetParam().pattern, std::regex::ECMAScript | std::regex::optimize);
    int files = 0;
    std::string names;
    for (const auto& [name, text] : texts()) {
        if (!std::regex_search(text, pattern)) continue;
        ++files;
        names += " " + name;
    }
    EXPECT_GE(files, kLeast) << GetParam().pattern << " is found in" << names;
}

INSTANTIATE_TEST_SUITE_P(
    Of, Constructs,
    testing::Values(
        Construct{"StringsInBrackets", R"(=\s*\(\s*")"}, Construct{"StatesFromAngles", R"((Enable|Mode|Ref|Mask)\s*=\s*<\s*\w+\s*>)"},
        Construct{"StatesFromBrackets", R"((Enable|Mode|Ref|Mask)\s*=\s*\(\s*[a-z]\w*\s*\))"},
        Construct{"StatesFromExpressions", R"((Enable|Mode|Ref|Blend)\s*=\s*\([^;")]*[<>?+*/][^;"]*;)"},
        Construct{"SamplerStatesFromParameters", R"((Filter|Address[UVW]|BorderColor|Anisotropy|Bias)\s*=\s*[<(])"},
        Construct{"ShaderArrays", R"((Vertex|Pixel)Shader\s+\w+\s*\[)"},
        Construct{"StructureParameters", R"(struct\s*\w*\s*\{[^}]*\}\s*\w+\s*[<=])"},
        Construct{"StructuresWithValues", R"(\n\s*[A-Z]\w+ \w+(\[\d\])?\s*(<[^>]*>)?\s*=\s*\{)"},
        Construct{"SelectorLabels", R"(=\s*\w+\?\w+)"}, Construct{"AnnotationLists", R"(<[^>]*\w+\s*=\s*[\d.]+f?\s*,\s*\w+\s*=)"},
        Construct{"ConstantIntrinsics", R"(float\d?\s+\w+\s*(<[^>]*>)?\s*=\s*\w*\(?\s*(normalize|sqrt|pow|cos|radians|exp2|log2)\s*\()"},
        Construct{"CommaValues", R"(float[234]\s+\w+\s*(<[^>]*>)?\s*=\s*\(\s*[\d.]+f?\s*,)"},
        Construct{"UnsizedArrays", R"(\w\s*\[\s*\]\s*=)"}, Construct{"ClearInScripts", R"(ClearColor\s*=\s*\(|ClearDepth\s*=\s*[\d.]+;)"},
        Construct{"SamplersInPasses", R"((Sampler|Texture)\s*\[\s*\d\s*\]\s*=)"},
        Construct{"FixedFunction", R"((Lighting|FogEnable|ColorOp\[0\]|ShadeMode|SpecularEnable)\s*=)"},
        Construct{"AlphaTest", R"([Aa]lphaTestEnable)"}, Construct{"AlphaFunction", R"(AlphaFunc\s*=)"},
        Construct{"StringInCapitals", R"(\bString\s+\w+\s*=)"}, Construct{"Pasting", R"(#define[^\n]*\w\s*##\s*\w)"},
        Construct{"StateObjectArrays", R"((RasterizerState|BlendState|DepthStencilState)\s+\w+\s*\[)"},
        Construct{"Methods", R"(\b(class|struct)\s+\w+[^;]*\{[^}]*\)\s*\{\s*return)"},
        Construct{"StencilReferences", R"(StencilRef\s*=\s*[<(]|SetDepthStencilState\(\s*\w+(\[\d\])?\s*,\s*g)"},
        Construct{"Multisampling", R"(MultisampleEnable)"}, Construct{"Assembly", R"(\basm\b)"},
        Construct{"StreamOutput", R"(ConstructGSWithSO)"},
        Construct{"IncludesInAnotherCase", R"(#\s*include "[^"\n]*(Inc/|Quad\.FXH|structures\.fxh|Material_Common|Shaders/))"},
        Construct{"Backslashes", R"(#\s*include "[^"\n]*\\)"}, Construct{"ScriptExternal", R"(ScriptExternal\s*=)"},
        Construct{"Srgb", R"(SRGBWriteEnable|SRGBTexture)"}, Construct{"ByteOrderMarks", "^\xef\xbb\xbf"},
        Construct{"CarriageReturns", R"(\r\n)"}, Construct{"ShiftJis", "[\x81-\x9f][\x40-\x7e]"}, Construct{"Pixels", R"(\bVPOS\b)"},
        Construct{"Faces", R"(\bVFACE\b)"}, Construct{"Controllers", R"(CONTROLOBJECT)"}, Construct{"Addresses", R"(SasBindAddress)"},
        Construct{"Functions", R"([Ff]unction\s*=\s*\(?")"}, Construct{"Volumes", R"(tex3D)"}, Construct{"Cubes", R"(texCUBE|TextureCube)"},
        Construct{"DepthTargets", R"(RENDERDEPTHSTENCILTARGET)"}, Construct{"Fill", R"(FillMode\s*=\s*([Ww]ire|WIRE|[Pp]oint))"},
        Construct{"Border", R"(Address\w\s*=\s*(BORDER|Border))"}, Construct{"Stencil", R"(StencilEnable\s*=\s*([Tt]rue|TRUE))"},
        Construct{"Scissor", R"([Ss]cissor\w*\s*=)"}, Construct{"Lit", R"(\blit\s*\()"}, Construct{"Levels", R"(tex2Dlod|texCUBElod)"},
        Construct{"Biases", R"(tex2Dbias)"}, Construct{"Projections", R"(tex2Dproj)"},
        Construct{"NoVertexShader", R"(VertexShader\s*=\s*(NULL|null|0)|pass\s+\w+\s*\{\s*(ZEnable = FALSE;)?\s*PixelShader)"},
        Construct{"Targets", R"(COLOR1|SV_Target1)"}, Construct{"Weights", R"(BLENDWEIGHT)"},
        Construct{"SharedParameters", R"(\bshared\b)"}, Construct{"Arguments", R"(compile\s+\w+\s+\w+\s*\(\s*[^)\s])"},
        Construct{"OpenGl", R"(\bOPENGL\b)"}, Construct{"GeometryShaders", R"(SetGeometryShader\s*\(\s*(C|g|S))"},
        Construct{"Loops", R"(LoopByCount)"}, Construct{"PointSizes", R"(PSIZE)"}, Construct{"Halves", R"(\bhalf\d?\b)"},
        Construct{"PackOffsets", R"(packoffset)"}, Construct{"StateBlocks", R"(stateblock_state)"},
        Construct{"Arcs", R"(\ba(cos|sin)\s*\(\s*[a-z])"}, Construct{"Instances", R"(float4x[34] \w+ : (BLENDWEIGHT|TEXCOORD))"},
        Construct{"WholeStreams", R"(int\d? \w+ : TEXCOORD)"}, Construct{"NamelessTechniques", R"([Tt]echnique\s*\{)"}),
    [](const testing::TestParamInfo<Construct>& tested) { return tested.param.name; });

} // namespace
} // namespace tegument::test
