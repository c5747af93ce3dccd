// Shaders in the assembly of Direct3D 9: functions of HLSL, with the registers that the pass gives.
// What is known of an effect when it is read: calls of its functions, parts of its constants, indices that the host has not set yet.

#include "host/effect/assembly.h"
#include "tests/effect/support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument::test {
namespace {

PipelineState direct3D9(const std::string& states) {
    return loaded("technique T { pass P { " + states + " } }").techniques[0].passes[0].state;
}

/// One state object and the call that uses it, in a technique11.
PipelineState direct3D11(const std::string& objects, const std::string& calls, const std::string& keyword = "technique11") {
    return loaded(objects + keyword + " T { pass P { " + calls + " } }").techniques[0].passes[0].state;
}

TEST(States, defaults_are_those_of_their_direct3d_version) {
    EXPECT_EQ(direct3D9("").depthCompare, CompareOp::LessEqual);
    EXPECT_EQ(direct3D11("", "").depthCompare, CompareOp::Less);
    EXPECT_EQ(direct3D9("").cull, CullMode::Back);
    EXPECT_FALSE(direct3D9("").frontCounterClockwise);
}

TEST(States, names_and_values_ignore_case_and_take_numbers) {
    EXPECT_EQ(direct3D9("ZFUNC = greater;").depthCompare, CompareOp::Greater);
    EXPECT_EQ(direct3D9("ZFunc = 3;").depthCompare, CompareOp::Equal);
    EXPECT_FALSE(direct3D9("zenable = false;").depthTest);
    EXPECT_FALSE(direct3D9("ZWriteEnable = 0;").depthWrite);
}

// Direct3D 9 culls by winding on screen with clockwise front faces, so CCW culls back faces.
TEST(States, direct3d9_cull_modes_cull_by_winding) {
    EXPECT_EQ(direct3D9("CullMode = NONE;").cull, CullMode::None);
    EXPECT_EQ(direct3D9("CullMode = CW;").cull, CullMode::Front);
    EXPECT_EQ(direct3D9("CullMode = CCW;").cull, CullMode::Back);
}

TEST(States, alpha_blends_like_colour_unless_separate) {
    const TargetBlend joint = direct3D9("SrcBlend = SRCALPHA; DestBlend = INVSRCALPHA; BlendOp = MAX; SrcBlendAlpha = ZERO;").targets[0];
    EXPECT_EQ(joint.srcAlpha, BlendFactor::SrcAlpha);
    EXPECT_EQ(joint.dstAlpha, BlendFactor::InvSrcAlpha);
    EXPECT_EQ(joint.opAlpha, BlendOp::Max);
    const TargetBlend separate =
        direct3D9("SrcBlend = SRCALPHA; SeparateAlphaBlendEnable = TRUE; SrcBlendAlpha = INVDESTALPHA;").targets[0];
    EXPECT_EQ(separate.src, BlendFactor::SrcAlpha);
    EXPECT_EQ(separate.srcAlpha, BlendFactor::InvDestAlpha);
}

TEST(States, write_masks_combine_names_and_apply_to_their_target) {
    const PipelineState state = direct3D9("ColorWriteEnable = RED | ALPHA; ColorWriteEnable2 = 0;");
    EXPECT_EQ(state.targets[0].writeMask, 9u);
    EXPECT_EQ(state.targets[1].writeMask, 9u);
    EXPECT_EQ(state.targets[2].writeMask, 0u);
}

TEST(States, stencil_of_back_faces_is_separate_only_in_two_sided_mode) {
    const std::string stencil =
        "StencilEnable = TRUE; StencilPass = INCRSAT; StencilFunc = LESS; StencilRef = 0x7f; StencilMask = 15; CCW_StencilPass = DECR;";
    EXPECT_EQ(direct3D9(stencil).stencilBack.pass, StencilOp::IncrSat);
    const PipelineState twoSided = direct3D9("TwoSidedStencilMode = TRUE; " + stencil);
    EXPECT_EQ(twoSided.stencilFront.pass, StencilOp::IncrSat);
    EXPECT_EQ(twoSided.stencilFront.compare, CompareOp::Less);
    EXPECT_EQ(twoSided.stencilBack.pass, StencilOp::Decr);
    EXPECT_EQ(twoSided.stencilReference, 127u);
    EXPECT_EQ(twoSided.stencilReadMask, 15u);
}

// Depth 9 gives the bias in units of depth; 2^-24 is one step of a 24-bit depth buffer.
TEST(States, direct3d9_depth_bias_is_converted_to_steps) {
    EXPECT_EQ(direct3D9("DepthBias = 0.5;").depthBias, 8388608.0f);
    EXPECT_EQ(direct3D9("SlopeScaleDepthBias = 2;").slopeScaledDepthBias, 2.0f);
}

TEST(States, turning_off_what_vulkan_has_not_is_accepted) {
    EXPECT_EQ(direct3D9("AlphaTestEnable = FALSE; FogEnable = false; Lighting = 0; SRGBWriteEnable = FALSE; ColorOp[1] = DISABLE;"),
              PipelineState{});
    EXPECT_EQ(firstCode(load("technique T { pass P { AlphaTestEnable = TRUE; } }")), 2003);
    EXPECT_EQ(firstCode(load("technique T { pass P { ColorOp[0] = MODULATE; } }")), 2003);
}

TEST(States, depth_stencil_objects_are_applied_with_their_reference) {
    const PipelineState state =
        direct3D11("DepthStencilState gZ { DepthEnable = TRUE; DepthWriteMask = ZERO; DepthFunc = GREATER_EQUAL; StencilEnable = TRUE;"
                   " FrontFaceStencilPass = INCR_SAT; BackFaceStencilFunc = NOT_EQUAL; };",
                   "SetDepthStencilState(gZ, 5);");
    EXPECT_FALSE(state.depthWrite);
    EXPECT_EQ(state.depthCompare, CompareOp::GreaterEqual);
    EXPECT_EQ(state.stencilFront.pass, StencilOp::IncrSat);
    EXPECT_EQ(state.stencilBack.compare, CompareOp::NotEqual);
    EXPECT_EQ(state.stencilReference, 5u);
}

TEST(States, blend_objects_of_direct3d11_copy_target_0_unless_independent) {
    const std::string object =
        "BlendState gB { BlendEnable[0] = TRUE; SrcBlend[0] = SRC_ALPHA; DestBlend = INV_SRC_ALPHA; RenderTargetWriteMask[0] = 7; ";
    const std::string call = "SetBlendState(gB, float4(1, 2, 3, 4), 0xffffffff);";
    const PipelineState joint = direct3D11(object + "};", call);
    EXPECT_TRUE(joint.targets[3].enable);
    EXPECT_EQ(joint.targets[3].writeMask, 7u);
    EXPECT_EQ(joint.blendConstant, (std::array<float, 4>{1, 2, 3, 4}));
    EXPECT_FALSE(direct3D11(object + "IndependentBlendEnable = TRUE; };", call).targets[3].enable);
}

TEST(States, blend_objects_of_direct3d10_keep_their_targets_apart) {
    const PipelineState state =
        direct3D11("BlendState gB { BlendEnable[0] = TRUE; };", "SetBlendState(gB, float4(0, 0, 0, 0), 0xffffffff);", "technique10");
    EXPECT_TRUE(state.targets[0].enable);
    EXPECT_FALSE(state.targets[1].enable);
}

TEST(States, rasterizer_objects_are_applied) {
    const PipelineState state =
        direct3D11("RasterizerState gR { CullMode = FRONT; FillMode = WIREFRAME; FrontCounterClockwise = TRUE; DepthBias = 3;"
                   " DepthClipEnable = FALSE; ScissorEnable = TRUE; };",
                   "SetRasterizerState(gR);");
    EXPECT_EQ(state.cull, CullMode::Front);
    EXPECT_EQ(state.fill, FillMode::Wireframe);
    EXPECT_TRUE(state.frontCounterClockwise);
    EXPECT_EQ(state.depthBias, 3.0f);
    EXPECT_FALSE(state.depthClip);
    EXPECT_TRUE(state.scissorTest);
}

TEST(States, a_null_object_restores_the_defaults) {
    const std::string object = "RasterizerState gR { CullMode = NONE; };";
    EXPECT_EQ(direct3D11(object, "SetRasterizerState(gR); SetRasterizerState(NULL);").cull, CullMode::Back);
}

TEST(States, the_spellings_of_two_direct3d_versions_do_not_mix) {
    EXPECT_EQ(firstCode(load("technique11 T { pass P { ZEnable = TRUE; } }")), 2003);
    EXPECT_EQ(firstCode(load("BlendState gB { }; technique T { pass P { SetBlendState(gB, float4(0,0,0,0), 0); } }")), 2003);
}

TEST(States, values_out_of_range_are_errors) {
    EXPECT_EQ(firstCode(load("technique T { pass P { ZFunc = 9; } }")), 2002);
    EXPECT_EQ(firstCode(load("technique T { pass P { ColorWriteEnable = 16; } }")), 2002);
    EXPECT_EQ(firstCode(load("technique T { pass P { StencilRef = 99999999999; } }")), 2002);
    EXPECT_EQ(firstCode(load("BlendState gB { BlendEnable[8] = TRUE; };")), 2002);
}

std::string translated(std::vector<std::string> lines, std::map<int, std::string> samplers = {}) {
    std::string why;
    const auto made = translateAssembly({.name = "f", .lines = std::move(lines), .samplers = std::move(samplers)}, why);
    return made ? made->text : "not: " + why;
}

TEST(Assembly, of_vertices_reads_declared_streams_and_writes_what_it_names) {
    const std::string text = translated({"vs_1_1", "dcl_position v0", "dcl_texcoord1 v3", "def c5, 0, 1, 0, 1", "m4x4 oPos, v0, c0",
                                         "mov oT0.xy, v3", "mov oD0, c5", "mov oFog, c5.y"});
    for (const char* part : {"float4 v0 : POSITION", "float4 v3 : TEXCOORD1", "out float4 oPos : POSITION", "out float4 oT0 : TEXCOORD0",
                             "out float oFog : FOG", "oPos = (float4(dot(v0, tg_c0), dot(v0, tg_c1), dot(v0, tg_c2), dot(v0, tg_c3)));",
                             "oT0.xy = (v3).xy;", "float4 tg_c5 = float4(0, 1, 0, 1);"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(Assembly, of_pixels_has_modifiers_and_samplers) {
    const std::string text = translated({"ps_1_1", "tex t0", "mul_x2 r0.rgb, 1-t0, v0_bx2", "+ mov_sat r0.a, -v0.a"}, {{0, "s"}});
    for (const char* part : {"t0 = (tex2D(s, t0.xy));", "r0.rgb = ((((1 - t0) * (2 * (v0 - 0.5))) * 2)).rgb;",
                             "r0.a = (saturate((-v0.aaaa))).a;", "float4 t0 : TEXCOORD0", "tg_result = r0;"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    const std::string later =
        translated({"ps_2_0", "dcl t0.xyz", "dcl_cube s1", "texld r0, t0, s1", "cmp oC0, r0.x, r0, c2"}, {{1, "sky"}});
    EXPECT_NE(later.find("texCUBE(sky, t0.xyz)"), std::string::npos) << later;
    EXPECT_NE(later.find("out float4 oC0 : COLOR0"), std::string::npos) << later;
}

TEST(Assembly, that_is_not_known_is_named) {
    EXPECT_EQ(translated({"vs_1_1", "mov oPos, v0", "callnz l0, b0"}), "not: callnz");
    EXPECT_EQ(translated({"xs_1_1"}), "not: xs_1_1");
    for (const std::map<int, std::string>& samplers : {std::map<int, std::string>{}, {{1, "s"}}})
        EXPECT_EQ(translated({"ps_1_3", "texm3x2pad t1, t0"}, samplers), "not: texm3x2pad");
}

TEST(Assembly, of_a_pass_is_its_shaders) {
    const Effect effect =
        loaded(load(Files{{"main.fx", "float4x4 m : WORLDVIEWPROJECTION; float3 tint = { 1, 0, 0 }; texture map;\n"
                                      "technique T { pass P { VertexShaderConstant[0] = <m>; VertexShaderConstant[4] = (tint);\n"
                                      "Texture[0] = <map>; VertexShader = asm {\nvs_1_1 ; first\ndcl_position v0\n"
                                      "m4x4 oPos, v0, c0\nmov oD0, c4 };\nPixelShader = asm {\nps.1.1\ntex t0\nmul r0, t0, v0\n};\n} }"}},
                    {.lenient = true}));
    const Pass& pass = effect.techniques[0].passes[0];
    ASSERT_TRUE(pass.vertexShader && pass.pixelShader);
    EXPECT_EQ(pass.vertexShader->profile, "vs_1_1");
    EXPECT_EQ(pass.assemblyShaders, 0);
    EXPECT_TRUE(effect.warnings.empty());
    for (const char* part : {"float4(m[0][1], m[1][1], m[2][1], m[3][1])", "float4(tint, 0)", "sampler tg_stage"})
        EXPECT_NE(effect.code.find(part), std::string::npos) << part << "\n" << effect.code;
    EXPECT_EQ(effect.samplers.back().texture, "map");
}

TEST(Assembly, that_is_not_translated_is_a_warning_and_its_pass_not_drawn) {
    const Effect effect =
        loaded(load(Files{{"main.fx", "technique T { pass P { PixelShader = asm {\nps_1_1\nrcq r0, t0\n}; } }"}}, {.lenient = true}));
    EXPECT_EQ(effect.techniques[0].passes[0].assemblyShaders, 1);
    EXPECT_TRUE(std::ranges::any_of(effect.warnings,
                                    [](const Diagnostic& w) { return w.code == 2021 && w.text.find("rcq") != std::string::npos; }));
}

const std::string kList = "float4 VS(float4 p : POSITION) : POSITION { return p; }\n"
                          "float4 zero() : COLOR { return 0; }\nfloat4 one() : COLOR { return 1; }\nfloat4 two() : COLOR { return 2; }\n"
                          "PixelShader list[3] = { compile ps_2_0 zero(), compile ps_2_0 one(), compile ps_2_0 two() };\n";

struct Case {
    std::string name;
    std::string declarations;
    std::string index;
    std::string entry; // which shader the index means
};
void PrintTo(const Case& tested, std::ostream* out) {
    *out << tested.index;
}

class IndexOfShaders : public testing::TestWithParam<Case> {};

TEST_P(IndexOfShaders, is_evaluated) {
    const Effect effect = loaded(load(
        Files{{"main.fx", GetParam().declarations + kList + "technique T { pass P { PixelShader = (list[" + GetParam().index + "]); } }"}},
        {.lenient = true}));
    ASSERT_TRUE(effect.techniques[0].passes[0].pixelShader);
    EXPECT_EQ(effect.techniques[0].passes[0].pixelShader->entry, GetParam().entry);
}

INSTANTIATE_TEST_SUITE_P(
    OfCalls, IndexOfShaders,
    testing::Values(Case{"a_parameter_s", "int bones = 4;\nint which() { return min(bones, 2); }\n", "which()", "two"},
                    Case{"with_a_choice",
                         "int k = 3;\nint pick(int a, bool b) { int r = a - 2; if (b && r > 0) { return r; } else return 0; }\n",
                         "pick(k, true)", "one"},
                    Case{"with_a_loop_and_a_call",
                         "int half(int n) { return n / 2; }\n"
                         "int steps(int n) { int c = 0; for (int i = 0; i < 4; ++i) { c += 1; }\nreturn c; }\n"
                         "int count(int n) { int c = 0; for (int i = half(n); i > 0; i -= 1) c++; return c; }\n",
                         "count(5)", "two"},
                    Case{"of_vectors",
                         "float3 v = { 0.25, 0.5, 2.9 };\nfloat largest(float3 a) { float3 b = a * 1; return max(b.x, max(b.y, b.z)); }\n",
                         "(int)largest(v)", "two"},
                    Case{"that_shadow_a_global", "int n = 2;\nint f(int n) { n = n + 1; return n; }\n", "f(0) + n - 2", "one"}),
    [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });

INSTANTIATE_TEST_SUITE_P(
    OfConstants, IndexOfShaders,
    testing::Values(
        Case{"a_structure", "struct Fog { bool on; float start; };\nstatic const Fog fog = { true, 1.0 };\nint kind = 2;\n",
             "(fog.on ? 1 : 0) * kind", "two"},
        Case{"a_structure_in_another",
             "struct In { int a[2]; };\nstruct Out { float3 c; In in0; };\nstatic const Out o = { { 1, 1, 1 }, { { 2, 1 } } };\n",
             "o.in0.a[1]", "one"},
        Case{"an_array_of_structures",
             "struct Lamp { float4 c; int kind; };\nstatic const Lamp lamps[2] = { { { 0, 0, 0, 0 }, 7 }, { { 1, 1, 1, 1 }, 2 } };\n",
             "lamps[1].kind", "two"},
        Case{"an_array", "static const int table[] = { 2, 1, 0 };\nint k = 1;\n", "table[k]", "one"}),
    [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });

INSTANTIATE_TEST_SUITE_P(OfWhatTheHostSets, IndexOfShaders,
                         testing::Values(Case{"below_zero", "int kind;\n", "kind - 1", "zero"},
                                         Case{"far_below_zero", "float kind = -7.5;\n", "kind * 2", "zero"},
                                         Case{"beyond_the_last", "int kind = 5;\n", "kind", "two"},
                                         Case{"into_a_table", "static const int table[2] = { 1, 2 };\nint kind = 9;\n", "table[kind]",
                                              "two"}),
                         [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });

TEST(IndexOfShaders, beyond_the_array_is_said) {
    const Effect effect = loaded(
        load(Files{{"main.fx", "int kind = 5;\n" + kList + "technique T { pass P { PixelShader = (list[kind]); } }"}}, {.lenient = true}));
    EXPECT_TRUE(std::ranges::any_of(effect.warnings, [](const Diagnostic& warning) { return warning.code == 2019; }));
}

TEST(EvaluatedStates, call_functions) {
    const auto passOf = [](const std::string& declarations, const std::string& state) {
        return loaded(load(Files{{"main.fx", declarations + "technique T { pass P { " + state + " } }"}}, {.lenient = true}))
            .techniques[0]
            .passes[0];
    };
    EXPECT_EQ(passOf("int a = 200; int ref() { return max(a, 10); }\n", "AlphaRef = ref();").alphaTest.reference, 200U);
    EXPECT_EQ(passOf("bool two = true; int sides(bool b) { return b ? 1 : 3; }\n", "CullMode = (sides(two));").state.cull, CullMode::None);
    EXPECT_TRUE(passOf("struct S { float o; }; static const S s = { 0.5 };\n", "AlphaBlendEnable = (s.o < 1);").state.targets[0].enable);
}

TEST(EvaluatedFunctions, that_never_end_or_call_themselves_are_no_values) {
    for (const std::string function :
         {"int f() { int i = 0; while (i < 1) { i = i * 1; } return i; }\n", "int f() { return f() + 1; }\n"}) {
        const auto effect =
            load(Files{{"main.fx", function + kList + "technique T { pass P { PixelShader = (list[f()]); } }"}}, {.lenient = true});
        EXPECT_EQ(firstCode(effect), 1106) << function;
    }
}

} // namespace
} // namespace tegument::test
