// Beckmann: precomputes 0.5 PH^0.1 (x = N.H, y = roughness m) for engines that prefer a look-up to an exponential, and shows it.
// Error of the texture against the formula: docs/design/modules/Beckmann.md.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/specular.fxh"
#include "passes/annotations.fxh"
#include "passes/quad.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("Beckmann") > = 0.8;

Texture2D gBeckmannMap : RENDERCOLORTARGET < SQUARE_TARGET(512, "A16B16G16R16F") >;
TG_SAMPLER2D(gBeckmann, POINT, CLAMP);

float4 BeckmannPS(TgQuadVarying input) : SV_Target0
{
    float encoded = tgBeckmannEncode(tgBeckmannPH(input.uv.x, input.uv.y));
    return float4(encoded, encoded, encoded, 1.0);
}

float4 ShowPS(TgQuadVarying input) : SV_Target0
{
    return tex2Dlod(gBeckmann, float4(input.uv, 0.0, 0.0));
}

#ifdef FX_TECHNIQUES
technique Beckmann < string Script =
    "RenderColorTarget0=gBeckmannMap; RenderDepthStencilTarget=; Pass=Precompute;"
    "RenderColorTarget0=; Pass=Show;"; >
{
    TG_QUAD_PASS(Precompute, TgQuadVS, BeckmannPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Show, TgQuadVS, ShowPS, TG_STATE_BUFFER)
}
#endif
// SPDX-License-Identifier: MIT
