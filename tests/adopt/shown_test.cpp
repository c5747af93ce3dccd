// What of a foreign effect is shown: which technique, which passes, where its light comes from, what fills its textures.

#include "meshprep/adopt/negated.h"
#include "tests/adopt/support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument::test {
namespace {

const std::string kShaders = "float4x4 m : WORLDVIEWPROJECTION;\nfloat4 VS(float4 p : POSITION) : POSITION { return mul(p, m); }\n"
                             "float4 PS() : COLOR { return 1; }\nfloat4 Gone(float2 t : TEXCOORD0) : COLOR { return noise(t); }\n";
const std::string kPass = "pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); }";

std::string shown(const std::string& techniques) {
    return adopted(foreign(kShaders + techniques)).effect.defaultTechnique()->name;
}

TEST(ShownTechnique, is_the_first_where_it_can_be_drawn) {
    EXPECT_EQ(shown("technique A { " + kPass + " } technique B { " + kPass + " }"), "A");
}

TEST(ShownTechnique, is_the_object_s_own_where_others_draw_edges_and_shadows) {
    EXPECT_EQ(shown("technique Edge < string MMDPass = \"edge\"; > { " + kPass +
                    " } technique Shadow < string MMDPass = \"shadow\"; > { }" + "technique Object < string MMDPass = \"object_ss\"; > { " +
                    kPass + " }"),
              "Object");
}

TEST(ShownTechnique, passes_over_what_this_host_cannot_draw) {
    const std::string gone = "technique Gone { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 Gone(); } } ";
    EXPECT_EQ(shown("technique Empty { } " + gone + "technique B { " + kPass + " }"), "B");
    EXPECT_EQ(shown(gone), "Gone") << "its message says why";
}

TEST(ShownTechnique, is_said_where_it_is_not_the_first) {
    const Adoption adoption = adopted(foreign(kShaders + "technique Empty { } technique B { " + kPass + " }"));
    EXPECT_TRUE(std::ranges::any_of(
        adoption.notes, [](const Diagnostic& note) { return note.text == "technique B is drawn where none is named, not Empty"; }));
}

TEST(ShownTechnique, has_colours) {
    EXPECT_EQ(
        shown(
            "float4 Place(float4 p : POSITION) : SV_Position { return mul(p, m); }\n"
            "technique10 Depth { pass P { SetVertexShader(CompileShader(vs_4_0, Place())); SetPixelShader(NULL); } }\n"
            "technique10 Lit { pass P { SetVertexShader(CompileShader(vs_4_0, Place())); SetPixelShader(CompileShader(ps_4_0, PS())); } }"),
        "Lit");
}

TEST(ShownPasses, over_the_target_have_the_half_pixel_of_direct3d_9) {
    const auto moves = [](const std::string& place, const std::string& profile) {
        const Effect effect =
            adopted(foreign("float4x4 m : WORLDVIEWPROJECTION;\nfloat4 VS(float4 p : POSITION) : SV_Position { return " + place +
                            "; }\nfloat4 PS() : COLOR { return 1; }\ntechnique T { pass P { VertexShader = compile vs_" + profile +
                            " VS(); PixelShader = compile ps_" + profile + " PS(); } }"))
                .effect;
        return effect.techniques[0].passes[0].vertexShader->code.find("tg_ViewportSize") != std::string::npos;
    };
    EXPECT_TRUE(moves("p", "3_0"));
    EXPECT_FALSE(moves("p", "4_0")) << "later ones have it at the corner, as Vulkan has";
    EXPECT_FALSE(moves("mul(p, m)", "3_0")) << "a mesh stays where it is";
}

TEST(ShownPasses, of_later_models_take_POSITION_where_nothing_is_SV_Position) {
    const auto writes = [](const std::string& outputs) {
        const Effect effect = adopted(foreign("void VS(float4 p : POSITION, " + outputs +
                                              ") { a = p; b = p; }\nfloat4 PS(float4 b : POSITION) : SV_Target { return b; }\n"
                                              "technique10 T { pass P { SetVertexShader(CompileShader(vs_4_0, VS())); "
                                              "SetPixelShader(CompileShader(ps_4_0, PS())); } }"))
                                  .effect;
        return effect.techniques[0].passes[0].vertexShader->code;
    };
    EXPECT_EQ(writes("out float4 a : TEXCOORD0, out float4 b : POSITION").find(": POSITION0"), std::string::npos);
    EXPECT_NE(writes("out float4 a : SV_Position, out float4 b : POSITION").find(": POSITION0"), std::string::npos);
}

TEST(ShownPasses, give_their_samplers_states) {
    const Effect effect =
        foreign("texture a, b; sampler A = sampler_state { Texture = <a>; }; sampler B = sampler_state { Texture = <b>; };\n"
                "float4 PS(float2 t : TEXCOORD0) : COLOR { return tex2D(A, t) + tex2D(B, t); }\n"
                "technique T { pass P { AddressU[1] = CLAMP; MinFilter[0] = LINEAR; PixelShader = compile ps_2_0 PS(); } }\n"
                "technique Later { pass P { AddressU[0] = MIRROR; PixelShader = compile ps_2_0 PS(); } }\n");
    EXPECT_EQ(effect.samplers[0].state.minFilter, Filter::Linear);
    EXPECT_EQ(effect.samplers[0].state.addressU, Address::Wrap) << "of the technique that is shown";
    EXPECT_EQ(effect.samplers[1].state.addressU, Address::Clamp);
}

TEST(ShownPasses, take_in_out_for_inout) {
    const Effect effect = adopted(foreign("float4x4 m : WORLDVIEWPROJECTION;\nvoid VS(in out float4 p : POSITION) { p = mul(p, m); }\n"
                                          "float4 PS() : COLOR { return 1; }\n" +
                                          std::string("technique T { ") + kPass + " }"))
                              .effect;
    EXPECT_NE(effect.techniques[0].passes[0].vertexShader->code.find("inout float4 p"), std::string::npos)
        << effect.techniques[0].passes[0].vertexShader->code;
}

TEST(ShownPasses, run_behind_a_script_that_names_none) {
    const Effect effect = adopted(foreign(kShaders + "technique T < string Script = \"RenderColorTarget0=;\"; > { " + kPass + " }")).effect;
    ASSERT_EQ(effect.techniques[0].script.commands.size(), 2U);
    EXPECT_EQ(effect.techniques[0].script.commands[1].kind, CommandKind::Pass);
    EXPECT_EQ(effect.techniques[0].script.commands[1].options, std::vector<std::string>{"P"});
}

TEST(ShownPasses, without_vertex_shader_and_depth_test_cover_the_target) {
    const auto draws = [](const std::string& state) {
        const Effect effect =
            adopted(foreign(kShaders + "technique T { pass P { " + state + " PixelShader = compile ps_2_0 PS(); } }")).effect;
        const Pass& pass = effect.techniques[0].passes[0];
        return pass.script.given ? pass.script.commands[0].options[0] : std::string("Geometry");
    };
    EXPECT_EQ(draws("ZEnable = FALSE;"), "Buffer");
    EXPECT_EQ(draws(""), "Geometry");
}

TEST(ShownPasses, that_all_leave_out_clockwise_faces_are_wound_the_other_way) {
    const auto cull = [](const std::string& passes) {
        return adopted(foreign(kShaders + "technique T { " + passes + " }")).effect.techniques[0].passes[0].state.cull;
    };
    const std::string inside = "pass A { CullMode = CW; VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } ";
    EXPECT_EQ(cull(inside), CullMode::Back);
    EXPECT_EQ(cull(inside + kPass), CullMode::Front) << "an outline";
}

struct TurnedCase {
    std::string name;
    std::string code;
    bool turned = true;
};
void PrintTo(const TurnedCase& tested, std::ostream* out) {
    *out << tested.code;
}
class TurnedRound : public testing::TestWithParam<TurnedCase> {};

TEST_P(TurnedRound, or_not) {
    const std::set<std::string> names = adopt::negatedNames(adopt::readCode("float3 light; float3 n;\n" + GetParam().code));
    EXPECT_EQ(names.contains("light"), GetParam().turned) << GetParam().code;
}

INSTANTIATE_TEST_SUITE_P(
    Lights, TurnedRound,
    testing::Values(TurnedCase{"at_once", "float f() { return dot(n, -light); }"},
                    TurnedCase{"inside_a_call", "float f() { return dot(n, -normalize(light.xyz)); }"},
                    TurnedCase{"once_for_all", "static float3 l = -light;"},
                    TurnedCase{"in_a_variable", "float f() { float3 l = normalize(light); return dot(n, -l); }"},
                    TurnedCase{"in_rows_of_a_matrix", "float3 f() { float3x3 d = 0; d[0] = float3x3(light, n, n)[0]; return mul(-d, n); }"},
                    TurnedCase{"by_a_function", "float g(float3 l) { return dot(n, -l); } float f() { return g(normalize(light)); }"},
                    TurnedCase{
                        "by_a_function_s_function",
                        "float h(float3 l) { return dot(n, -l); } float g(float3 l) { return h(l); } float f() { return g(light); }"},
                    TurnedCase{"not_in_a_difference", "float3 f() { return n - light; }", false},
                    TurnedCase{"not_where_a_number_is", "float f() { float d = dot(n, light); return -d; }", false},
                    TurnedCase{"not_where_a_sum_is", "float3 f() { float3 h = n + light; return -h; }", false},
                    TurnedCase{"not_where_a_name_is_a_parameter_s", "float f(float3 light) { return dot(n, -light); }", false}),
    [](const testing::TestParamInfo<TurnedCase>& tested) { return tested.param.name; });

TEST(TurnedRound, may_be_a_member_of_a_structure_that_a_function_takes) {
    const std::string light = "struct Light { float4 Colour; float3 Direction; float3 Away; }; Light sun; Light all[3]; float3 n;\n";
    const auto negated = [&](const std::string& code, const std::string& parameter) {
        return adopt::isNegated(adopt::negatedNames(adopt::readCode(light + code)), parameter);
    };
    const std::string inside = "float g(Light l) { float3 to = -l.Direction; return dot(to, n); } float f() { return g(all[1]); }";
    EXPECT_TRUE(negated(inside, "all_1_Direction"));
    EXPECT_TRUE(negated(inside, "sun_Direction"));
    EXPECT_FALSE(negated(inside, "all_1_Away"));
    EXPECT_TRUE(negated("float f() { return dot(n, normalize(-all[2].Direction.xyz)); }", "all_2_Direction"));
    EXPECT_TRUE(negated("float f() { float3 l = normalize(sun.Direction); return dot(n, -l); }", "sun_Direction"));
    EXPECT_TRUE(negated("float g(float3 l) { return dot(n, -l); } float f() { return g(sun.Direction); }", "sun_Direction"));
    EXPECT_FALSE(negated("float f() { return dot(n, sun.Direction); }", "sun_Direction"));
    EXPECT_FALSE(negated("float4 v; float f() { return dot(n, -v.xyz); }", "some_xyz")) << "a swizzle is no member";
}

Effect filled(const std::string& annotations, const std::string& type = "texture") {
    return adopted(foreign("float4 fill(float2 p : POSITION, float2 s : PSIZE) : COLOR { return float4(p, s); }\n" + type +
                           " t < string function = \"fill\"; " + annotations +
                           " >; sampler s = sampler_state { Texture = <t>; };\nfloat4 VS(float4 p : POSITION) : POSITION { return p; }\n"
                           "float4 PS(float2 uv : TEXCOORD0) : COLOR { return tex2D(s, uv); }\n"
                           "technique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }\n"
                           "technique Other { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = NULL; } }\n"))
        .effect;
}

TEST(FilledTextures, are_targets_that_a_pass_draws_first) {
    const Effect effect = filled("float2 Dimensions = { 64, 16 };");
    const Parameter* texture = effect.findParameter("t");
    EXPECT_EQ(texture->semantic, "RENDERCOLORTARGET");
    EXPECT_EQ(texture->annotations.numbers("Width"), std::vector<double>{64});
    EXPECT_EQ(texture->annotations.numbers("Height"), std::vector<double>{16});
    const std::vector<Command>& commands = effect.techniques[0].script.commands;
    ASSERT_EQ(commands.size(), 4U);
    EXPECT_EQ(commands[0].options[0], "t");
    EXPECT_EQ(effect.techniques[0].findPass(commands[1].options[0])->pixelShader->original, "fill");
    EXPECT_EQ(commands[2].options[0], "");
    EXPECT_EQ(commands[3].options[0], "P");
}

TEST(FilledTextures, cost_nothing_where_no_shader_reads_them) {
    EXPECT_FALSE(filled("").techniques[1].script.given);
}

TEST(FilledTextures, keep_a_stand_in_where_the_function_is_not_there) {
    const Effect effect = adopted(foreign("texture t < string function = \"nowhere\"; >; sampler2D s = sampler_state { Texture = <t>; };\n"
                                          "float4 PS(float2 uv : TEXCOORD0) : COLOR { return tex2D(s, uv); }\n" +
                                          kRest))
                              .effect;
    EXPECT_TRUE(effect.findParameter("t")->annotations.find("Procedure"));
}

TEST(Kernels, in_pixels_become_those_in_texels) {
    const Effect effect = adopted(foreign("float2 k[2] = { { -2, 1 }, { 4, 0 } };\nfloat2 t[2] < string ConvertPixelsToTexels = \"k\"; >;"),
                                  {.width = 8, .height = 4})
                              .effect;
    EXPECT_EQ(std::get<std::vector<double>>(*effect.findParameter("t")->defaultValue), (std::vector<double>{-0.25, 0.25, 0.5, 0}));
}

} // namespace
} // namespace tegument::test
