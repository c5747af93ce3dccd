// PreintegratedTable: precomputes light around a ring over N.L (x) and curvature (y), less its unscattered part, and shows it on a grey
// ground.
#include "../../hlsl/platform.fxh"
#include "../../hlsl/settings.fxh"
#include "../../hlsl/space.fxh"
#include "../../hlsl/workspace.fxh"
#include "../../hlsl/surface/normal.fxh"
#include "../../hlsl/peers/ring.fxh"
#include "../../hlsl/peers/ring_light.fxh"
#include "../../hlsl/printed/preintegrated.fxh"
#include "../../hlsl/peers/preintegrated.fxh"
#include "../passes/annotations.fxh"
#include "../passes/quad.fxh"
#include "../passes/profile.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("PreintegratedTable") > = 0.8;

Texture2D gPreintegratedMap : RENDERCOLORTARGET < int Width = 257; int Height = 65; int MipLevels = 1; string Format = "A16B16G16R16F"; >;
TG_SAMPLER2D(gPreintegrated, POINT, CLAMP);

float4 PreintegratedTablePS(TgQuadVarying input) : SV_Target0
{
    float2 arguments = tgPreintegratedArguments(input.uv);
    return float4(tgPreintegratedTexel(gGaussianWeight, arguments.x, arguments.y), 1.0);
}

float4 ShowPS(TgQuadVarying input) : SV_Target0
{
    return float4(0.5 + tex2Dlod(gPreintegrated, float4(input.uv, 0.0, 0.0)).rgb, 1.0);
}

#ifdef FX_TECHNIQUES
technique PreintegratedTable < string Script =
    "RenderColorTarget0=gPreintegratedMap; RenderDepthStencilTarget=; Pass=Precompute;"
    "RenderColorTarget0=; Pass=Show;"; >
{
    TG_QUAD_PASS(Precompute, TgQuadVS, PreintegratedTablePS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Show, TgQuadVS, ShowPS, TG_STATE_BUFFER)
}
#endif
// SPDX-License-Identifier: MIT
