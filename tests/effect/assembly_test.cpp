// Shaders in the assembly of Direct3D 9: functions of HLSL, with the registers that the pass gives.

#include "host/effect/assembly.h"
#include "tests/effect/support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument::test {
namespace {

std::string translated(std::vector<std::string> lines, std::map<int, std::string> samplers = {}) {
    std::string why;
    const auto made = translateAssembly({.name = "f", .lines = std::move(lines), .constants = {}, .samplers = std::move(samplers)}, why);
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

} // namespace
} // namespace tegument::test
