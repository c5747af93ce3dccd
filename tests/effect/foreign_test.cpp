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
        foreign("technique T { pass P { VertexShader = NULL; PixelShader = asm { ps_1_3\n texm3x2pad t1, t0\n mov r0, t1 }; } }");
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

/// The first warning as text; empty where there is none.
std::string warningOf(const std::string& text) {
    const Effect effect = foreign(text);
    return effect.warnings.empty() ? std::string() : format(effect.warnings.front());
}

TEST(ForeignNames, that_are_words_of_the_language_are_said) {
    const std::string words[][2] = {{"bool sampler2D;", "main.fx(1,6)"},
                                    {"float4x4 gWorld : NULL;", "main.fx(1,19)"},
                                    {"float a < float register = 1; > = 1;", "main.fx(1,17)"},
                                    {"technique true { }", "main.fx(1,11)"},
                                    {"technique T { pass Technique { } }", "main.fx(1,20)"},
                                    {"gWorld float4x4 : WORLD;", "main.fx(1,8)"}, // in the wrong order
                                    {"sampler Texture2D = sampler_state { };", "main.fx(1,9)"}};
    for (const auto& [text, place] : words) {
        const std::string said = warningOf(text);
        EXPECT_TRUE(said.starts_with(place + ": warning TG1101: expected ")) << text << ": " << said;
        EXPECT_NE(said.find("a word of the language; 'my_"), std::string::npos) << text << ": " << said;
        EXPECT_EQ(firstCode(load(text)), 1101) << text << ": an error where reading is strict";
    }
}

TEST(ForeignTypes, that_nobody_declares_are_said_where_a_parameter_has_them) {
    EXPECT_NE(warningOf("FillMode gWorld : WORLD;").find("main.fx(1,1): warning TG1103: unknown type 'FillMode'"), std::string::npos);
    EXPECT_NE(warningOf("flaot gWorld;").find("did you mean 'float'?"), std::string::npos);
    EXPECT_EQ(firstCode(load("FillMode gWorld : WORLD;")), 1103);
    EXPECT_EQ(firstCode(load("Texture2D<float4> a : register(t0); SomethingNew b : register(t1);")), 0) << "the compiler's business";
    EXPECT_EQ(warningOf("struct S { float a; }; typedef float4 C; S s; C c; RWTexture2D<float4> o; StructuredBuffer<S> b;"), "");
}

TEST(ForeignTypes, that_shaders_have_none_of_are_said_once) {
    const std::string technique = "technique T { pass P { PixelShader = compile ps_2_0 PS(); } }";
    const std::string two = "half4 gFirst; half gSecond;\n";
    EXPECT_NE(warningOf(two + kShaders + technique).find("main.fx(1,7): warning TG2025: 'gFirst' is a global half4"), std::string::npos);
    EXPECT_EQ(foreign(two + kShaders + technique).warnings.size(), 1U);
    EXPECT_NE(warningOf("double d;" + kShaders + technique).find("TG2025"), std::string::npos);
    EXPECT_EQ(firstCode(load(two + kShaders + technique)), 2025);
    EXPECT_EQ(warningOf(two + kShaders), "") << "no shader asks for it";
    const std::string later = "technique11 T { pass P { SetPixelShader(CompileShader(ps_4_0, PS())); } }";
    EXPECT_NE(warningOf(two + kShaders + later).find("TG2025"), std::string::npos);
    EXPECT_EQ(warningOf("double d;" + kShaders + later), "") << "of which Direct3D 11 has some";
    EXPECT_EQ(warningOf("struct S { half a; }; S s;" + kShaders + technique), "") << "Microsoft's compiler takes it";
}

TEST(ForeignNames, that_are_values_of_states_are_said_where_these_are_meant) {
    for (const std::string text : {"float4x4 LINEAR; sampler s = sampler_state { MinFilter = LINEAR; };",
                                   "sampler NONE; technique T { pass P { CullMode = NONE; } }"}) {
        const std::string said = warningOf(text);
        EXPECT_NE(said.find("warning TG2015: '"), std::string::npos) << said;
        EXPECT_NE(said.find("and the name of a parameter; rename the parameter"), std::string::npos) << said;
        EXPECT_EQ(firstCode(load(text)), 2015);
    }
    EXPECT_EQ(warningOf("float LINEAR; sampler s = sampler_state { MinFilter = POINT; };"), "");
}

TEST(ForeignShaders, that_are_given_brackets_without_a_value_are_said) {
    const std::string technique = "technique T { pass P { VertexShader = compile vs_2_0 VS(";
    EXPECT_NE(warningOf(kShaders + technique + "()); } }").find("warning TG1101: expected a value, found ')'"), std::string::npos);
    EXPECT_EQ(warningOf(kShaders + technique + "(2)); } }"), "");
    EXPECT_EQ(warningOf(kShaders + technique + "); } }"), "");
}

TEST(ForeignBuffers, are_said_where_microsofts_compiler_refuses_them) {
    const std::string rest = "{ float4 a; };";
    for (const std::string head : {"cbuffer ", "cbuffer string ", "cbuffer B / ", "cbuffer cbuffer B ", "cbuffer float4 "})
        EXPECT_NE(warningOf(head + rest).find("warning TG1101: expected "), std::string::npos) << head;
    for (const std::string member : {"texture t;", "sampler2D s;", "string t[2];"})
        EXPECT_NE(warningOf("cbuffer B { float a; " + member + " };").find("is not a type of constant buffers"), std::string::npos)
            << member;
    for (const std::string head : {"cbuffer B ", "tbuffer B : register(t3) ", "shared cbuffer B : register(b0) "})
        EXPECT_EQ(warningOf(head + rest + " texture t;"), "") << head;
}

TEST(ForeignStates, with_indices_that_are_no_whole_numbers_and_without_a_semicolon_are_said) {
    EXPECT_NE(warningOf("BlendState b { BlendEnable[1.0f] = TRUE; };").find("TG2002: an index is a whole number"), std::string::npos);
    EXPECT_NE(warningOf("BlendState b { BlendEnable[0] = TRUE; } RasterizerState r { };").find("TG1101: expected ';'"), std::string::npos);
    EXPECT_NE(warningOf("BlendState b { AlphaToCoverageEnable[0] = TRUE; };").find("TG2002: AlphaToCoverageEnable has no index"),
              std::string::npos);
    EXPECT_EQ(warningOf("BlendState b { BlendEnable[0] = TRUE; SrcBlend[1] = ONE; }; RasterizerState r[2] { { }, { } };"), "");
}

TEST(ForeignStates, that_are_set_with_other_values_than_microsofts_compiler_takes_are_said) {
    const std::string objects = "BlendState b { }; DepthStencilState d { }; RasterizerState r { };\n";
    const auto passOf = [&](const std::string& calls) { return objects + "technique11 T { pass P { " + calls + " } }"; };
    for (const std::string call : {"SetBlendState(b, float4(0, 0, 0, 0) * 0xff);", "SetDepthStencilState(d);"})
        EXPECT_NE(warningOf(passOf(call)).find("warning TG1105: Set"), std::string::npos) << call << warningOf(passOf(call));
    EXPECT_NE(warningOf(passOf("SetDepthStencilState(d, \"x\");")).find("warning TG1101"), std::string::npos)
        << "it takes a string for a number";
    EXPECT_EQ(warningOf(passOf("SetBlendState(b, float4(0, 0, 0, 0), 0xff); SetDepthStencilState(d, 1); SetRasterizerState(r);")), "");
}

TEST(ForeignArrays, that_have_neither_a_size_nor_a_value_are_said) {
    EXPECT_NE(warningOf("float gScale[];").find("main.fx(1,7): warning TG1107: array 'gScale'"), std::string::npos);
    EXPECT_EQ(warningOf("float gScale[] = { 1, 2 }; Texture2D t[] : register(t0);"), "");
}

TEST(ForeignStrings, that_are_numbers_are_read_and_said) {
    const std::string said = warningOf("string gScale[2] = { 1, 2 };");
    EXPECT_NE(said.find("warning TG1101: expected a string"), std::string::npos) << said;
    EXPECT_EQ(firstCode(load("string gScale[2] = { 1, 2 };")), 1101);
}

TEST(ForeignNames, that_microsofts_compiler_takes_are_names) {
    for (const std::string text : {"float sample; float Texture; float STRING; float DWORD; float vs_2_0; float float16_t;",
                                   "float a : float4;", "float a < float half3 = 1; > = 1;", "technique T { pass bool { } }",
                                   "technique Matrix { pass TRUE { } }", "#define True true\nbool a = True;"})
        EXPECT_EQ(warningOf(text), "") << text;
}

TEST(ForeignValues, true_and_false_in_capitals_are_of_states_alone) {
    for (const std::string text : {"float3 gAxis = { 0, TRUE, -2 };", "bool gOn = FALSE;", "float a < bool b = TRUE; > = 1;"}) {
        const std::string said = warningOf(text);
        EXPECT_NE(said.find("warning TG1104: '" + std::string(text.find("TRUE") != std::string::npos ? "TRUE" : "FALSE")),
                  std::string::npos)
            << said;
        EXPECT_NE(said.find("; write "), std::string::npos) << said;
        EXPECT_EQ(firstCode(load(text)), 1104) << text;
    }
    EXPECT_EQ(numbers(foreign("bool gOn = TRUE;"), "gOn"), std::vector<double>{1}) << "it is read all the same";
    EXPECT_EQ(warningOf(kShaders + "technique T { pass P { ZEnable = TRUE; AlphaBlendEnable = (FALSE); } }"), "");
}

TEST(ForeignValues, that_name_a_parameter_are_read_and_said) {
    for (const std::string text :
         {"float2 a = 3;\nfloat b = a.y;", "float a = 3; float2 b = {\na, 1 };", "struct S { float x; }; S a = { 3 };\nfloat b = -a.x;",
          "int b = 3; static const int a = b;\nint c = 2 * a;", "float a = 3; float b <\nfloat UIMin = a; > = 4;"}) {
        const std::string said = warningOf(text);
        EXPECT_TRUE(said.starts_with("main.fx(2,")) << text << ": " << said;
        EXPECT_NE(said.find("warning TG1104: 'a' is a parameter: it is not a constant; write its value"), std::string::npos) << said;
        EXPECT_EQ(firstCode(load(text)), 1104) << text;
    }
    EXPECT_EQ(numbers(foreign("float2 a = 3; float b = a.y;"), "b"), std::vector<double>{3}) << "it is read all the same";
    EXPECT_EQ(warningOf("float x = 1; static const float2 a = 3; float b < float UIMin = a.x; > = a.x;"), "");
}

TEST(ForeignSamplers, may_read_a_texture_in_brackets_that_only_the_host_declares) {
    for (const char* text :
         {"sampler2D s : register(s0) { Texture = (SpriteTexture); };", "sampler s = sampler_state { Texture = <gMap>; };",
          "SamplerState s { Filter = ANISOTROPIC; Texture = (Screen); };"}) {
        EXPECT_TRUE(warns(foreign(text), 2012)) << text;
        EXPECT_EQ(firstCode(load(text)), 2012) << text;
    }
}

TEST(ForeignSamplers, that_name_two_textures_read_the_last_one) {
    const Effect effect = foreign("texture a; texture b; sampler s = sampler_state { Texture = <a>; Texture = <b>; };");
    EXPECT_EQ(effect.findSampler("s")->texture, "b");
    EXPECT_EQ(
        firstCode(load({{"main.fx", "texture a; sampler s = sampler_state { Texture = <a>; Texture = LINEAR; };"}}, {.lenient = true})),
        2012)
        << "Microsoft's compiler does not begin";
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
