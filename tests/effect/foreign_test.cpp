// What Microsoft's compiler reads in the effects of other hosts: one construct each. Values are what its binary holds.

#include "tests/effect/support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument::test {
namespace {

const std::string kShaders = "float4 VS(float4 p : POSITION, uniform int n = 0) : POSITION { return p * n; }\n"
                             "float4 PS() : COLOR { return 1; }\n";

Effect foreign(const Files& files) {
    return loaded(load(files, {.lenient = true}));
}

Effect foreign(const std::string& text) {
    return foreign(Files{{"main.fx", text}});
}

/// The pass of an effect that consists of these declarations and these states.
Pass passOf(const std::string& declarations, const std::string& states) {
    return foreign(kShaders + declarations + "technique T { pass P { " + states + " } }").techniques[0].passes[0];
}

bool warns(const Effect& effect, int code) {
    return std::ranges::any_of(effect.warnings, [&](const Diagnostic& warning) { return warning.code == code; });
}

TEST(ForeignStates, take_their_values_from_parameters_in_each_bracket) {
    const std::string parameters = "bool gBlend = true; int gCull = 1; float gOpacity = 0.5;\n";
    EXPECT_TRUE(passOf(parameters, "AlphaBlendEnable = <gBlend>;").state.targets[0].enable);
    EXPECT_EQ(passOf(parameters, "CullMode = (gCull);").state.cull, CullMode::None);
    EXPECT_EQ(passOf(parameters, "CullMode = gCull;").state.cull, CullMode::None);
    EXPECT_TRUE(passOf(parameters, "AlphaBlendEnable = (gOpacity < 0.99);").state.targets[0].enable);
    EXPECT_FALSE(passOf(parameters, "AlphaBlendEnable = (gOpacity >= 0.99 && gBlend);").state.targets[0].enable);
    EXPECT_EQ(passOf(parameters, "CullMode = gBlend ? 2 : 3;").state.cull, CullMode::Front);
}

TEST(ForeignStates, of_samplers_take_them_too) {
    const Effect effect =
        foreign("texture t; int gFilter = 2; float4 gEdge[2] = { 1,0,0,1, 0,0,1,1 };\n"
                "sampler s = sampler_state { Texture = (t); MinFilter = <gFilter>; MagFilter = gFilter; BorderColor = gEdge[1]; };");
    EXPECT_EQ(effect.samplers[0].state.minFilter, Filter::Linear);
    EXPECT_EQ(effect.samplers[0].state.magFilter, Filter::Linear);
    EXPECT_EQ(effect.samplers[0].state.borderColor, (std::array<float, 4>{0, 0, 1, 1}));
    EXPECT_EQ(effect.samplers[0].texture, "t");
}

struct PassedOver {
    std::string name;
    std::string before; // the technique
    std::string states; // of its pass
};
class ForeignStatesPassedOver : public testing::TestWithParam<PassedOver> {};

TEST_P(ForeignStatesPassedOver, are_warned_about_and_those_behind_them_hold) {
    const Effect effect = foreign(GetParam().before + "technique T { pass P { " + GetParam().states + " ZEnable = FALSE; } }");
    EXPECT_TRUE(warns(effect, 2003));
    EXPECT_FALSE(effect.techniques[0].passes[0].state.depthTest);
}

INSTANTIATE_TEST_SUITE_P(
    Of, ForeignStatesPassedOver,
    testing::Values(PassedOver{"fixed_function", "",
                               "Lighting = TRUE; ColorOp[0] = MODULATE; LightEnable[12] = 1; VertexShaderConstant[20] = 3;"
                               " ShadeMode = Gouraud; MultisampleAntialias = TRUE;"},
                    PassedOver{"samplers_in_a_pass", "texture t; sampler s = sampler_state { Texture = <t>; };\n",
                               "Sampler[0] = (s); Texture[1] = <t>; AddressU[1] = Clamp;"}),
    [](const testing::TestParamInfo<PassedOver>& tested) { return tested.param.name; });

TEST(ForeignStates, of_the_alpha_test_are_kept) {
    const AlphaTest test = passOf("int gRef = 8;\n", "AlphaTestEnable = TRUE; AlphaRef = <gRef>; AlphaFunc = GreaterEqual;").alphaTest;
    EXPECT_EQ(test, (AlphaTest{true, CompareOp::GreaterEqual, 8}));
    EXPECT_EQ(passOf("", "AlphaTestEnable = FALSE; AlphaFunc = Greater;").alphaTest.enable, false);
    EXPECT_TRUE(passOf("", "SRGBWriteEnable = TRUE;").encodesSrgb);
}

TEST(ForeignObjects, come_in_arrays) {
    const Effect shaders = foreign(kShaders + "int gN = 1; VertexShader vs[2] = { compile vs_2_0 VS(4), compile vs_2_0 VS(5) };\n"
                                              "technique T { pass P { VertexShader = (vs[gN]); PixelShader = NULL; } }");
    EXPECT_EQ(shaders.techniques[0].passes[0].vertexShader->arguments, std::vector<std::string>{"5"});
    const Effect states =
        foreign("int gMode; RasterizerState rs[2] { { FillMode = SOLID; }, { FillMode = WIREFRAME; MultisampleEnable = TRUE; } };\n"
                "technique11 T { pass P { SetRasterizerState(rs[gMode + 1]); } }");
    EXPECT_EQ(states.techniques[0].passes[0].state.fill, FillMode::Wireframe);
    const Effect samplers =
        foreign("texture a; texture b; sampler2D s[2] = { sampler_state { Texture = <a>; }, sampler_state { Texture = <b>; } };");
    EXPECT_EQ(samplers.findSampler("s[1]")->texture, "b");
}

TEST(ForeignObjects, take_parameters_as_arguments_of_their_calls) {
    const Effect effect = foreign("int id = 3; DepthStencilState ds { DepthEnable = TRUE; };\n"
                                  "technique10 T { pass P { SetDepthStencilState(ds, id); } }");
    EXPECT_EQ(effect.techniques[0].passes[0].state.stencilReference, 3U);
}

TEST(ForeignObjects, that_this_host_cannot_draw_are_named_and_read) {
    const Effect assembly =
        foreign("technique T { pass P { VertexShader = asm { vs_1_1\n dcl_position v0\n mov oPos, v0 }; PixelShader = NULL; } }");
    EXPECT_EQ(assembly.techniques[0].passes[0].assemblyShaders, 1);
    EXPECT_TRUE(warns(assembly, 2021));
    const Effect stream =
        foreign("struct V { float4 p : POSITION; }; V VS(V v) { return v; }\n"
                "GeometryShader gs = ConstructGSWithSO(CompileShader(vs_4_0, VS()), \"POSITION.xyzw\");\n"
                "technique10 T { pass P { SetVertexShader(CompileShader(vs_4_0, VS())); SetGeometryShader(gs); SetPixelShader(NULL); } }");
    EXPECT_TRUE(stream.techniques[0].passes[0].streamOutput);
    const Effect hull = foreign("float4 F() : SV_Target { return 0; } technique11 T { pass P { SetHullShader(CompileShader(hs_5_0, F()));"
                                " SetDomainShader(CompileShader(ds_5_0, F())); } }");
    EXPECT_EQ(hull.techniques[0].passes[0].hullShader->profile, "hs_5_0");
    EXPECT_EQ(hull.techniques[0].passes[0].domainShader->entry, "F");
}

TEST(ForeignValues, of_structures_are_parameters_with_members) {
    const Effect effect =
        foreign("struct { float3 Color; float3 Direction; } gLight[2] < string UIName = \"x\"; > = { 1,1,1, 0,0,1, 0,0,0, 0,0,1 };\n"
                "struct Wave { float f; float2 d; }; Wave gWave = { 1, float2(2, 3) }; float gCopy = gWave.d.y;");
    const Parameter* light = effect.findParameter("gLight");
    ASSERT_NE(light, nullptr);
    ASSERT_TRUE(light->type.members);
    EXPECT_EQ(light->type.members->at(1).name, "Direction");
    EXPECT_EQ(light->type.elements, 2);
    EXPECT_EQ(numbers(effect, "gLight")[5], 1);
    EXPECT_EQ(numbers(effect, "gCopy"), std::vector<double>{3});
}

TEST(ForeignValues, are_constant_expressions_with_intrinsics) {
    const Effect effect = foreign("float3 gDirection = normalize(float3(3, 0, -4)); static const float kL = log2(8.0); float gK = kL;\n"
                                  "float3 gWeights = (0.299f, 0.587f, 0.114f); float2 gCut = float4(1, 2, 3, 4); int gColor = 0xff202080;\n"
                                  "float gMost = max(1, min(7, 4)) + dot(float3(1, 2, 3), 1); bool gNot = !(1 > 2);");
    EXPECT_DOUBLE_EQ(numbers(effect, "gDirection")[2], -0.8);
    EXPECT_EQ(numbers(effect, "gK"), std::vector<double>{3});
    EXPECT_EQ(numbers(effect, "gWeights"), (std::vector<double>{0.114, 0.114, 0.114}));
    EXPECT_EQ(numbers(effect, "gCut"), (std::vector<double>{1, 2}));
    EXPECT_EQ(numbers(effect, "gColor"), std::vector<double>{-14671744});
    EXPECT_EQ(numbers(effect, "gMost"), std::vector<double>{10});
    EXPECT_EQ(numbers(effect, "gNot"), std::vector<double>{1});
}

TEST(ForeignValues, may_be_infinite_and_passes_may_share_a_name) {
    const Effect effect = foreign("float gMost = 1.#INF; sampler s = sampler_state { DMapOffset = 0; };\n"
                                  "technique T { pass A { ZEnable = FALSE; } pass A { } }");
    EXPECT_GT(numbers(effect, "gMost")[0], 3e38);
    EXPECT_TRUE(warns(effect, 2015));
    EXPECT_EQ(effect.techniques[0].passes.size(), 2U);
}

TEST(ForeignValues, in_buffers_of_a_pool_are_parameters) {
    EXPECT_NE(foreign("shared cbuffer Pool { float4 gShared; };").findParameter("gShared"), nullptr);
}

TEST(ForeignValues, size_arrays_by_constants_and_by_themselves) {
    const Effect effect = foreign("const int N = 4; float4 gA[N]; float4 kernel[] = { float4(1,0,0,0), float4(0,1,0,0) };");
    EXPECT_EQ(effect.findParameter("gA")->type.elements, 4);
    EXPECT_EQ(effect.findParameter("kernel")->type.elements, 2);
}

TEST(ForeignAnnotations, take_brackets_lists_and_types_in_any_case) {
    const Effect effect = foreign("texture t < string Format = (\"A8R8G8B8\"); int width = 4, height = 8; String UIName = \"t\"; >;");
    EXPECT_EQ(effect.parameters[0].annotations.string("Format"), "A8R8G8B8");
    EXPECT_EQ(effect.parameters[0].annotations.numbers("height"), std::vector<double>{8});
    EXPECT_EQ(effect.parameters[0].annotations.string("uiname"), "t");
}

TEST(ForeignAnnotations, without_a_meaning_here_are_warned_about) {
    const Effect effect =
        foreign("float g < string UIMin = \"0\"; string Format = \"DXT9\"; int Script = 1; string Script = \"x\"; > = 1;");
    EXPECT_TRUE(warns(effect, 2015) && warns(effect, 2016) && warns(effect, 2017));
}

TEST(ForeignMacros, expand_before_they_become_strings_and_paste_strings) {
    const Effect effect = foreign("#define N 12\n#define S(x) #x\n#define cat(a, b) a##b\n"
                                  "string a = S(N); string b = cat(\"Default/\", \"a.png\");");
    EXPECT_EQ(std::get<std::string>(*effect.parameters[0].defaultValue), "12");
    EXPECT_EQ(std::get<std::string>(*effect.parameters[1].defaultValue), "Default/a.png");
}

TEST(ForeignIncludes, are_found_beside_the_effect_that_includes_the_includer) {
    const Effect effect = foreign({{"main.fx", "#include \"sub\\b.fxh\"\nfloat gA = kOne;"},
                                   {"sub/b.fxh", "#include \"c.fxh\"\n"},
                                   {"c.fxh", "static const float kOne = 1;"}});
    EXPECT_EQ(numbers(effect, "gA"), std::vector<double>{1});
}

TEST(ForeignIncludes, are_found_in_another_case_with_a_warning) {
    const Result<Effect> effect = loadEffect("tests/effect/foreign/case.fx", {.lenient = true});
    ASSERT_TRUE(effect) << format(effect.error());
    EXPECT_TRUE(warns(*effect, 1013));
    EXPECT_NE(effect->findParameter("gX"), nullptr);
    EXPECT_FALSE(loadEffect("tests/effect/foreign/case.fx"));
}

TEST(ForeignScripts, choose_by_labels) {
    const Effect effect = foreign("float Script : STANDARDSGLOBAL < string Script = \"Technique=Technique?A:B;\"; > = 0.8;\n"
                                  "technique A { pass P { } } technique B { pass P { } }");
    EXPECT_EQ(effect.defaultTechnique()->name, "A");
    Log log;
    ASSERT_TRUE(runScripts(effect, "", log));
    EXPECT_EQ(log.lines, (std::vector<std::string>{"begin P", "P: geometry to app", "end P"}));
}

TEST(ForeignScripts, drop_what_is_unknown_with_a_warning) {
    const Effect effect =
        foreign("technique T < string Script = \"ScriptExternal=Scene; LoopByCount=gNone; Pass=P; LoopEnd; Pass=Q; Bogus=1;\"; >\n"
                "{ pass P < string Script = \"RenderColorTarget0 = ;\" \"ClearColor = (0, 0, 0, 255);\" \"Draw=Buffer;\"; > { } }");
    EXPECT_TRUE(warns(effect, 2004) && warns(effect, 2011) && warns(effect, 2013));
    Log log;
    ASSERT_TRUE(runScripts(effect, "", log));
    EXPECT_EQ(std::ranges::count(log.lines, "P: buffer to app"), 1);
    EXPECT_EQ(log.lines[0], "external");
}

TEST(ForeignDeclarations, hold_methods_and_stages_by_name) {
    const Effect effect = foreign("interface iL { float3 f(float3 n); }; class cL : iL { float3 c; float3 f(float3 n); };\n"
                                  "float3 cL::f(float3 n) { return c; } float4 PS() : SV_Target { return 1; }\n"
                                  "technique11 T { pass P { SetPixelShader(CompileShader(ps_5_0, PS())); } }");
    EXPECT_EQ(effect.techniques[0].passes[0].pixelShader->entry, "PS");
}

TEST(ForeignEffects, written_for_this_host_are_read_strictly) {
    EXPECT_FALSE(load(Files{{"main.fx", "#ifdef FX_ENTRY\n#endif\ntechnique T { pass P { Lighting = TRUE; } }"}}, {.lenient = true}));
    EXPECT_TRUE(load(Files{{"main.fx", "technique T { pass P { Lighting = TRUE; } }"}}, {.lenient = true}));
}

TEST(ForeignEffects, are_still_refused_where_microsofts_compiler_refuses) {
    EXPECT_FALSE(load(Files{{"main.fx", "technique T { pass P { NoSuchState = TRUE; } }"}}, {.lenient = true}));
    EXPECT_FALSE(load(Files{{"main.fx", "technique T { pass P { VertexShader = compile vs_2_0 None(); } }"}}, {.lenient = true}));
    EXPECT_FALSE(load(Files{{"main.fx", "technique T { pass P { CullMode = }"}}, {.lenient = true}));
}

TEST(Foreign, constant_buffers_may_have_annotations) {
    const Effect effect = foreign("cbuffer Pool : register(b1) < string UIName = \"a\"; > { float4 gShared; };");
    EXPECT_NE(effect.findParameter("gShared"), nullptr);
    EXPECT_EQ(effect.code.find("UIName"), std::string::npos) << "compilers know none";
}

TEST(Foreign, samplers_may_name_textures_of_types_that_are_not_drawn) {
    const Effect effect =
        foreign("Texture2DArray gTrees; Texture2D gLayers[2]; Texture2DMS<float4, 4> gMany;\n"
                "SamplerState a { Texture = gTrees; }; SamplerState b { Texture = gLayers[1]; }; SamplerState c { Texture = gMany; };");
    EXPECT_EQ(effect.findSampler("a")->texture, "");
    EXPECT_EQ(effect.findSampler("b")->texture, "gLayers");
    EXPECT_EQ(firstCode(load(Files{{"main.fx", "SamplerState a { Texture = gNone; };"}}, {.lenient = true})), 2012);
}

TEST(Foreign, functions_in_the_place_of_shaders_are_told_from_unknown_names) {
    const auto message = [](const std::string& pass) {
        const auto effect = load("float4 Show() : COLOR { return 1; }\ntechnique T { pass { " + pass + " } }");
        return effect ? std::string() : format(effect.error());
    };
    EXPECT_NE(message("PixelShader = Show;").find("compile PROFILE Show()"), std::string::npos) << message("PixelShader = Show;");
    EXPECT_NE(message("VertexShader = PostProcessVS;").find("ReShade"), std::string::npos) << "of an include that is not there";
    EXPECT_EQ(message("PixelShader = gShader;").find("compile"), std::string::npos);
}

} // namespace
} // namespace tegument::test
