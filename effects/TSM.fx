// TSM: depth and texture coordinates of the surface nearest to the light, shown as (depth between the light's planes, u, v).
#include "../hlsl/platform.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/workspace.fxh"
#include "passes/annotations.fxh"
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/quad.fxh"
#include "passes/tsm.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("TSM") > = 0.8;

float4 ShowPS(TgQuadVarying input) : SV_Target0
{
    float4 texel = tex2Dlod(gTsm, float4(input.uv, 0.0, 0.0));
    float depth = kTgDepthInMillimetres
        ? (texel.x - tgMillimetres(gLightNear)) / max(tgMillimetres(gLightFar - gLightNear), 1e-6) : texel.x;
    return float4(float3(saturate(depth), texel.yz) * texel.w, 1.0);
}

#ifdef FX_TECHNIQUES
technique TSM < string Script =
    TSM_SCRIPT
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Show;"; >
{
    TSM_PASS
    TG_QUAD_PASS(Show, TgQuadVS, ShowPS, TG_STATE_BUFFER)
}
#endif
// SPDX-License-Identifier: MIT
