#include "tests/effect/support.h"

#include <gtest/gtest.h>

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

} // namespace
} // namespace tegument::test
