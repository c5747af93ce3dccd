// What reaches the outputs of a foreign shader decides how it is drawn: light, geometry, depth; and what Direct3D 9 did behind shaders.

#include "tests/adopt/support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument::test {
namespace {

struct Case {
    std::string name;
    std::string code; // declares `dir`, VS, PS and what they need
    std::string expected;
};
void PrintTo(const Case& tested, std::ostream* out) {
    *out << tested.code;
}

const std::string kTechnique = "\ntechnique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }\n";
const std::string kVs = "float4x4 m : WORLDVIEWPROJECTION;\nvoid VS(float4 p : POSITION, float3 n : NORMAL, out float4 o : POSITION, "
                        "out float3 on : TEXCOORD0) { o = mul(p, m); on = n; }\n";

class LightDirections : public testing::TestWithParam<Case> {};

TEST_P(LightDirections, are_what_the_code_takes_them_for) {
    const Effect effect = adopted(foreign(GetParam().code + kTechnique)).effect;
    const auto bound = std::ranges::find_if(effect.parameters, [](const Parameter& p) { return p.name.find("dir") != std::string::npos; });
    ASSERT_NE(bound, effect.parameters.end());
    EXPECT_EQ(bound->semantic, GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Of, LightDirections,
    testing::Values(
        Case{"modelling_programs",
             "float4 dir : Direction < string Object = \"TargetLight\"; > = { -0.5, -0.5, 0.7, 1 };\n" + kVs +
                 "float4 PS(float3 n : TEXCOORD0) : COLOR { return saturate(dot(normalize(n), dir.xyz)); }",
             "TOLIGHT"},
        Case{"hosts_that_hand_over_the_way_of_light",
             "float3 dir : DIRECTION < string Object = \"Light\"; >;\n" + kVs +
                 "float4 PS(float3 n : TEXCOORD0) : COLOR { float3 l = normalize(-dir); return max(0, dot(n, l)); }",
             "LIGHTDIRECTION"},
        Case{"an_address",
             "float3 dir < string SasBindAddress = \"Sas.DirectionalLight[0].Direction\"; >;\n" + kVs +
                 "float lambert(float3 a, float3 b) { return saturate(dot(a, b)); }\n"
                 "float4 PS(float3 n : TEXCOORD0) : COLOR { return lambert(n, normalize(dir)); }",
             "TOLIGHT"},
        Case{"a_varying",
             "float3 dir : LIGHTDIR0_DIRECTION;\nfloat4x4 m : WORLDVIEWPROJECTION;\nstruct V { float4 p : POSITION; float3 n : TEXCOORD0; "
             "float3 l : TEXCOORD1; };\n"
             "V VS(float4 p : POSITION, float3 n : NORMAL) { V o = (V)0; o.p = mul(p, m); o.n = n; o.l = dir * -1; return o; }\n"
             "float4 PS(V i) : COLOR { float3 l = i.l; return saturate(dot(normalize(i.n), normalize(l))); }",
             "LIGHTDIRECTION"},
        Case{"a_tangent_space",
             "float3 dir : DIRECTION < string Object = \"DirectionalLight\"; >;\nfloat4x4 m : WORLDVIEWPROJECTION;\n"
             "void VS(float4 p : POSITION, float3 n : NORMAL, float3 t : TANGENT, out float4 o : POSITION, out float3 l : TEXCOORD0) {\n"
             "float3x3 tbn = float3x3(t, cross(n, t), n); o = mul(p, m); l = mul(tbn, dir); }\n"
             "float4 PS(float3 l : TEXCOORD0) : COLOR { float3 n = float3(0, 0, 1); float d = dot(n, l); if (d < 0) d = 0; return "
             "saturate(d); }",
             "TOLIGHT"},
        Case{"the_normal_turned_round_instead",
             "float3 dir : DIRECTION < string Object = \"Light\"; >;\n" + kVs +
                 "float4 PS(float3 n : TEXCOORD0) : COLOR { return saturate(dot(-n, dir)); }",
             "LIGHTDIRECTION"},
        Case{"code_that_does_not_tell",
             "float3 dir : DIRECTION < string Object = \"Light\"; >;\n" + kVs +
                 "float4 PS(float3 n : TEXCOORD0) : COLOR { return float4(abs(dir), n.x); }",
             "LIGHTDIRECTION"}),
    [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });

const std::string kPs = "float4 PS() : COLOR { return 1; }\n";

class DrawnGeometry : public testing::TestWithParam<Case> {};

TEST_P(DrawnGeometry, follows_from_what_reaches_the_position) {
    const Effect effect = adopted(foreign(GetParam().code + kPs + kTechnique)).effect;
    const Pass& pass = effect.techniques[0].passes[0];
    const bool quad = std::ranges::any_of(pass.script.commands, [](const Command& c) { return c.options.front() == "Buffer"; });
    const bool pixels = pass.vertexShader->code.find("* float2(0.5, -0.5) + 0.5)") != std::string::npos;
    const bool farthest = pass.pixelShader->code.find("SV_Depth") != std::string::npos;
    EXPECT_EQ(std::string(quad ? "quad" : "mesh") + (pixels ? ", pixels" : "") + (farthest ? ", farthest" : ""), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Where, DrawnGeometry,
    testing::Values(
        Case{"a_matrix_makes_only_a_ray",
             "float4x4 m;\nvoid VS(float4 p : POSITION, out float4 o : POSITION, out float3 r : TEXCOORD0) { o = p; r = mul(p, m).xyz; }\n",
             "quad"},
        Case{"a_matrix_makes_only_coordinates",
             "float4x4 texMatrix;\nstruct V { float4 p : POSITION; float2 t : TEXCOORD0; };\n"
             "V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V o; o.t = mul(float4(t, 0, 1), texMatrix).xy; o.p = float4(p.xy, 0, 1); "
             "return o; }\n",
             "quad"},
        Case{"sprites_are_placed",
             "float4x4 MatrixTransform;\nvoid VS(float4 p : POSITION, out float4 o : POSITION) { o = mul(p, MatrixTransform); }\n", "quad"},
        Case{"a_matrix_places_by_way_of_functions",
             "float4x4 world, viewProj;\nfloat4 place(float4 p) { float4 w = mul(p, world); return mul(w, viewProj); }\n"
             "void VS(float4 p : POSITION, out float4 o : POSITION) { float4 q = p; q.xyz *= 1.0; o = place(q); }\n",
             "mesh"},
        Case{"its_rows_place",
             "float4x4 m;\nvoid VS(float4 p : POSITION, out float4 o : POSITION) { o = p.x * m[0] + p.y * m[1] + p.z * m[2] + m[3]; }\n",
             "mesh"},
        Case{"a_structure_holds_it",
             "struct S { float4x4 wvp; float4 c; };\nS s;\nvoid VS(float4 p : POSITION, out float4 o : POSITION) { o = mul(p, s.wvp); }\n",
             "mesh"},
        Case{"a_branch_places",
             "float4x4 m; bool b;\nvoid VS(float4 p : POSITION, out float4 o : POSITION) { o = p; if (b) o = mul(p, m); }\n", "mesh"},
        Case{"it_is_divided_by_the_size",
             "float2 ViewportSize;\nvoid VS(float4 p : POSITION, out float4 o : POSITION) { p.xy /= ViewportSize; p.xy = p.xy * float2(2, "
             "-2) - "
             "float2(1, -1); o = p; }\n",
             "quad, pixels"},
        Case{"it_is_multiplied_with_the_inverse",
             "float2 InvScreenSize;\nfloat4 clip4(float2 a) { return float4(a * 2 - 1, 0, 1); }\n"
             "void VS(float4 p : POSITION, out float4 o : POSITION) { o = clip4(p.xy * InvScreenSize); }\n",
             "quad, pixels"},
        Case{"one_component_at_a_time",
             "float2 targetSize : VIEWPORTPIXELSIZE;\nvoid VS(float4 p : POSITION, out float4 o : POSITION) { o = float4(2 * p.x / "
             "targetSize.x - 1, "
             "1 - 2 * p.y / targetSize.y, 0, 1); }\n",
             "quad, pixels"},
        Case{"only_coordinates_are_divided_by_it",
             "float2 ViewportSize;\nvoid VS(float4 p : POSITION, float2 t : TEXCOORD0, out float4 o : POSITION, out float2 u : TEXCOORD0) "
             "{ o = p; u = "
             "t + 0.5 / ViewportSize; }\n",
             "quad"},
        Case{"depth_is_w", "float4x4 m;\nvoid VS(float4 p : POSITION, out float4 o : POSITION) { o = mul(p, m).xyww; }\n",
             "mesh, farthest"},
        Case{"depth_is_set_to_w", "float4x4 m;\nvoid VS(float4 p : POSITION, out float4 o : POSITION) { o = mul(p, m); o.z = o.w; }\n",
             "mesh, farthest"},
        Case{"depth_is_w_of_a_structure",
             "float4x4 m;\nstruct V { float4 p : POSITION; };\nV VS(float4 p : POSITION) { V v; float4 q = mul(p, m); v.p = float4(q.xy, "
             "q.w, q.w); return "
             "v; }\n",
             "mesh, farthest"}),
    [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });

std::string codeOf(const std::string& shaders, const std::string& states, bool pixel) {
    const Effect effect = adopted(foreign(shaders + "technique T { pass P { " + states + " } }")).effect;
    const Pass& pass = effect.techniques[0].passes[0];
    return pixel ? pass.pixelShader->code : pass.vertexShader->code;
}

TEST(FixedFunction, adds_the_second_colour_where_there_is_no_pixel_shader) {
    const std::string vs =
        "float4x4 m : WORLDVIEWPROJECTION;\nvoid VS(float4 p : POSITION, out float4 o : POSITION, out float4 d : COLOR0, "
        "out float4 s : COLOR1) { o = mul(p, m); d = 0; s = 1; }\n";
    const std::string added = "o.rgb = saturate(o.rgb + s.rgb)";
    EXPECT_NE(codeOf(vs, "VertexShader = compile vs_2_0 VS(); SpecularEnable = true;", true).find(added), std::string::npos);
    EXPECT_EQ(codeOf(vs, "VertexShader = compile vs_2_0 VS();", true).find(added), std::string::npos);
    EXPECT_EQ(codeOf(vs, "VertexShader = compile vs_2_0 VS(); SpecularEnable = (0);", true).find(added), std::string::npos);
}

TEST(FixedFunction, fogs_what_shaders_before_model_3_draw) {
    const std::string vs =
        "float4x4 m : WORLDVIEWPROJECTION;\nvoid VS(float4 p : POSITION, out float4 o : POSITION, out float f : FOG) { o = "
        "mul(p, m); f = 0; }\nfloat4 PS() : COLOR { return 1; }\n";
    const std::string both = "VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); ";
    EXPECT_NE(codeOf(vs, both + "FogEnable = true; FogColor = 0xff00ff00;", true).find("lerp(float3(0, 1, 0), "), std::string::npos);
    EXPECT_NE(codeOf(vs, "VertexShader = compile vs_2_0 VS(); FogEnable = TRUE; FogColor = (float4(1, 0, 0, 1));", true)
                  .find("lerp(float3(1, 0, 0), "),
              std::string::npos)
        << "without a pixel shader, too";
    EXPECT_EQ(codeOf(vs, both + "FogColor = 0xff00ff00;", true).find("lerp(float3(0"), std::string::npos);
    EXPECT_EQ(
        codeOf(vs, "VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); FogEnable = true;", true).find("lerp(float3(0"),
        std::string::npos);
}

TEST(TypedBuffers, that_nothing_fills_hold_identities) {
    for (const char* type : {"Buffer<float4>", "Buffer<float3>", "Buffer"}) {
        const std::string code = codeOf(
            std::string(type) + " bones;\nfloat4x4 m : WORLDVIEWPROJECTION;\nvoid VS(float3 p : POSITION, out float4 o "
                                ": SV_Position) { o = mul(float4(p, 1), m) * bones.Load(4).x; }\nfloat4 PS() : SV_Target { return 1; }\n",
            "VertexShader = compile vs_4_0 VS(); PixelShader = compile ps_4_0 PS();", false);
        EXPECT_NE(code.find("static tg_rows bones"), std::string::npos) << type;
        EXPECT_EQ(code.find("Buffer<"), std::string::npos) << type;
    }
}

TEST(FreeStreams, are_known_by_what_direct3d_10_layouts_call_them) {
    const auto reads = [](const std::string& semantics) {
        return codeOf("float4x4 m : WORLDVIEWPROJECTION;\nvoid VS(" + semantics +
                          ", out float4 o : SV_Position) { o = mul(float4(a.xyz, 1), m) + b.x; }\nfloat4 PS() : SV_Target { return 1; }\n",
                      "VertexShader = compile vs_4_0 VS(); PixelShader = compile ps_4_0 PS();", false);
    };
    EXPECT_NE(reads("float3 a : POS, float3 b : NORM").find(": NORMAL"), std::string::npos);
    EXPECT_NE(reads("float3 a : VERTEX, float2 b : TEXTURE0").find(": TEXCOORD0"), std::string::npos);
    EXPECT_NE(reads("float3 a : POS, float4 b : TAN").find(": TANGENT"), std::string::npos);
    EXPECT_EQ(reads("float3 a : POSIX, float3 b : NORMA").find(": NORMAL"), std::string::npos) << "others only look like it";
}

} // namespace
} // namespace tegument::test
