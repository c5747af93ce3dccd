#include "tests/effect/support.h"

#include <gtest/gtest.h>

namespace tegument::test {
namespace {

std::string code(const std::string& text) {
    return loaded(text).code;
}

TEST(CodeView, effect_syntax_is_blanked_and_shader_text_is_kept) {
    EXPECT_EQ(code("float4 gTint : DIFFUSE < string UIName = \"Tint\"; > = { 1, 2, 3, 4 };\n"
                   "float4 P() : SV_Target0 { return gTint < 1 ? 0 : 1; }\n"
                   "technique T { pass P { PixelShader = compile ps_3_0 P(); } }\n"),
              "#line 1 \"main.fx\"\n"
              "float4 gTint                                                       ;\n"
              "float4 P() : SV_Target0 { return gTint < 1 ? 0 : 1; }\n");
}

TEST(CodeView, lines_and_columns_stay_where_they_were) {
    EXPECT_EQ(code("SamplerState gS\n{\n    AddressU = WRAP;\n};\n\n  float4 gA;"),
              "#line 1 \"main.fx\"\nSamplerState gS\n\n\n ;\n\n  float4 gA;\n");
}

TEST(CodeView, far_jumps_and_includes_get_a_line_directive) {
    const Effect effect = loaded(load(Files{{"main.fx", "float gA;\n#include \"a.fxh\"\nfloat gC;\n"}, {"a.fxh", "\nfloat gB;"}}));
    EXPECT_EQ(effect.code, "#line 1 \"main.fx\"\nfloat gA;\n#line 2 \"a.fxh\"\nfloat gB;\n#line 3 \"main.fx\"\nfloat gC;\n");
}

TEST(CodeView, is_preprocessed_with_fx_entry) {
    EXPECT_NE(code("#if FX_ENTRY\nfloat gEntry;\n#endif\n#ifdef FX_D3D11\nfloat gMeta;\n#endif").find("gEntry"), std::string::npos);
    EXPECT_EQ(code("#ifdef FX_D3D11\nfloat gMeta;\n#endif").find("gMeta"), std::string::npos);
}

TEST(CodeView, metadata_is_preprocessed_with_fx_d3d11) {
    const Effect effect = loaded("#ifdef FX_D3D11\nfloat gMeta;\n#endif\n#ifdef FX_ENTRY\nfloat gEntry;\n#endif");
    EXPECT_NE(effect.findParameter("gMeta"), nullptr);
    EXPECT_EQ(effect.findParameter("gEntry"), nullptr);
}

TEST(CodeView, strings_state_objects_and_the_global_script_vanish) {
    EXPECT_EQ(code("string gText = \"a\"; BlendState gB { BlendEnable[0] = TRUE; }; float Script : STANDARDSGLOBAL = 0.8;"), "\n");
}

TEST(CodeView, qualifiers_that_compilers_misread_are_blanked) {
    EXPECT_EQ(code("const float gA = 3; uniform float gB; static const float kC = 3;"),
              "#line 1 \"main.fx\"\n      float gA    ;         float gB; static const float kC = 3;\n");
}

TEST(CodeView, pragmas_reach_the_compilers) {
    EXPECT_NE(code("float gA;\n#pragma pack_matrix(row_major)\nfloat gB;").find("\n#pragma pack_matrix(row_major)\n"), std::string::npos);
}

TEST(CodeView, operators_of_macros_are_not_torn_apart) {
    EXPECT_NE(code("#define LESS(a, b) ((a) <= (b))\nbool f(float x) { return LESS(x, 1); }").find("<="), std::string::npos);
}

TEST(CodeView, neighbours_of_macros_are_not_glued_together) {
    const std::string text = code("#define MINUS -\nfloat f(float x) { return MINUS-x; }");
    EXPECT_EQ(text.find("--"), std::string::npos) << text;
}

TEST(Direct3D9Intrinsics, are_found_with_their_position) {
    const std::optional<Diagnostic> found = direct3D9Intrinsic(loaded(
        load(Files{{"main.fx", "\n#include \"a.fxh\"\n"}, {"a.fxh", "\n\nfloat4 f() { return tex2Dlod(s, float4(0, 0, 0, 0)); }"}})));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->at.file, "a.fxh");
    EXPECT_EQ(found->at.line, 3);
    EXPECT_EQ(found->at.column, 21);
}

TEST(Direct3D9Intrinsics, macros_that_spell_them_in_direct3d10_are_fine) {
    EXPECT_FALSE(direct3D9Intrinsic(loaded("#define tex2D(s, uv) s##Map.Sample(s, uv)\nTexture2D gSkinMap; SamplerState gSkin;\n"
                                           "float4 f(float2 uv) { return tex2D(gSkin, uv); }")));
}

} // namespace
} // namespace tegument::test
