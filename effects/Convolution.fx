// Convolution: the cascade of Gaussians over the irradiance; shows the six maps weighted by the profile. Technique Poisson: Gosselin's
// blurs, gBlurCount of them; shows the last. Techniques White and WhitePoisson feed them the constant gConstantIrradiance instead, over the
// charts of the mesh: what comes out is the sum of the weights.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/specular.fxh"
#include "../hlsl/light.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/scatter.fxh"
#include "passes/annotations.fxh"
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/quad.fxh"
#include "passes/materials.fxh"
#include "passes/skin_parameters.fxh"
#include "passes/tsm.fxh"
#include "passes/shadow_map.fxh"
#include "passes/lamp_light.fxh"
#include "passes/lamps.fxh"
#include "passes/more_light.fxh"
#include "passes/surface.fxh"
#include "passes/specular.fxh"
#include "passes/skin_point.fxh"
#include "passes/diffuse_share.fxh"
#include "passes/more_light_sum.fxh"
#include "passes/energy_share.fxh"
#include "passes/irradiance.fxh"
#include "passes/irradiance_gosselin.fxh"
#include "passes/stretch.fxh"
#include "passes/profile.fxh"
#include "passes/convolution.fxh"
#include "passes/blur_parameters.fxh"
#include "passes/poisson.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("Convolution") > = 0.8;

float4 gConstantIrradiance < UI_COLOUR("Light of technique White") > = { 1.0, 1.0, 1.0, 0.5 };

struct ConstantVarying
{
    float4 position : SV_Position;
};

ConstantVarying ConstantVS(TgVertexInput stored)
{
    TgMeshInput input = meshVertex(stored);
    ConstantVarying output;
    output.position = TG_HALF_PIXEL(tgUnwrapPosition(input.uv, 0.0), gViewportSize);
    return output;
}

float4 ConstantPS(ConstantVarying input) : SV_Target0
{
    return gConstantIrradiance;
}

// Alpha: 1 inside the charts of the irradiance, 0 outside.
float4 ShowPS(TgQuadVarying input) : SV_Target0
{
    float4 uv = float4(input.uv, 0.0, 0.0);
    float4 first = tex2Dlod(gIrradiance, uv);
    float3 sum = first.rgb * gGaussianWeight[0].rgb + tex2Dlod(gIrradiance2, uv).rgb * gGaussianWeight[1].rgb +
                 tex2Dlod(gIrradiance3, uv).rgb * gGaussianWeight[2].rgb + tex2Dlod(gIrradiance4, uv).rgb * gGaussianWeight[3].rgb +
                 tex2Dlod(gIrradiance5, uv).rgb * gGaussianWeight[4].rgb + tex2Dlod(gIrradiance6, uv).rgb * gGaussianWeight[5].rgb;
    return float4(sum, 1.0) * tgSeamValidity(first);
}

float4 ShowOddPS(TgQuadVarying input) : SV_Target0
{
    float4 texel = tex2Dlod(gBlurOdd, float4(input.uv, 0.0, 0.0));
    return float4(texel.rgb, 1.0) * tgSeamValidity(tex2Dlod(gIrradiance, float4(input.uv, 0.0, 0.0)));
}

float4 ShowEvenPS(TgQuadVarying input) : SV_Target0
{
    float4 texel = tex2Dlod(gBlurEven, float4(input.uv, 0.0, 0.0));
    return float4(texel.rgb, 1.0) * tgSeamValidity(tex2Dlod(gIrradiance, float4(input.uv, 0.0, 0.0)));
}

#ifdef FX_TECHNIQUES
technique Convolution < string Script =
    LAMPS_SCRIPT OWN_SHADOW_SCRIPT TSM_SCRIPT
    IRRADIANCE_SCRIPT("Irradiance")
    CASCADE_SCRIPT
    "RenderColorTarget0=; Pass=Show;"; >
{
    LAMPS_PASSES
    OWN_SHADOW_PASS
    TSM_PASS
    TG_MESH_PASS(Irradiance, IrradianceVS, IrradiancePS, TG_STATE_BUFFER)
    CASCADE_PASSES(TG_STATE_BUFFER)
    TG_QUAD_PASS(Show, TgQuadVS, ShowPS, TG_STATE_BUFFER)
}

technique White < string Script =
    IRRADIANCE_SCRIPT("Constant")
    CASCADE_SCRIPT
    "RenderColorTarget0=; Pass=Show;"; >
{
    TG_MESH_PASS(Constant, ConstantVS, ConstantPS, TG_STATE_BUFFER)
    CASCADE_PASSES(TG_STATE_BUFFER)
    TG_QUAD_PASS(Show, TgQuadVS, ShowPS, TG_STATE_BUFFER)
}

technique Poisson < string Script =
    LAMPS_SCRIPT SHADOW_MAP_SCRIPT
    IRRADIANCE_SCRIPT("Irradiance")
    BLURS_SCRIPT
    "RenderColorTarget0=;" BLURRED_SCRIPT("ShowOdd", "ShowEven"); >
{
    LAMPS_PASSES
    SHADOW_MAP_PASS
    TG_MESH_PASS(Irradiance, IrradianceVS, GosselinIrradiancePS, TG_STATE_BUFFER)
    BLUR_PASSES_1_TO_3(TG_STATE_BUFFER)
    BLUR_PASSES_4_TO_6(TG_STATE_BUFFER)
    TG_QUAD_PASS(ShowOdd, TgQuadVS, ShowOddPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ShowEven, TgQuadVS, ShowEvenPS, TG_STATE_BUFFER)
}

technique WhitePoisson < string Script =
    IRRADIANCE_SCRIPT("Constant")
    BLURS_SCRIPT
    "RenderColorTarget0=;" BLURRED_SCRIPT("ShowOdd", "ShowEven"); >
{
    TG_MESH_PASS(Constant, ConstantVS, ConstantPS, TG_STATE_BUFFER)
    BLUR_PASSES_1_TO_3(TG_STATE_BUFFER)
    BLUR_PASSES_4_TO_6(TG_STATE_BUFFER)
    TG_QUAD_PASS(ShowOdd, TgQuadVS, ShowOddPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ShowEven, TgQuadVS, ShowEvenPS, TG_STATE_BUFFER)
}
#endif
// SPDX-License-Identifier: MIT
