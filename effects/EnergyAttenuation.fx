// EnergyAttenuation: precomputes the directional albedo rho_dt of the specular lobe (x = cosine, y = roughness m, rho_s = 1), two halves
// whose sum it is, and shows it.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/specular.fxh"
#include "passes/annotations.fxh"
#include "passes/quad.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("EnergyAttenuation") > = 0.8;

Texture2D gEnergyAttenuationMap : RENDERCOLORTARGET < SQUARE_TARGET(128, "G16R16F") >;
TG_SAMPLER2D(gEnergyAttenuation, POINT, CLAMP);

float4 EnergyAttenuationPS(TgQuadVarying input) : SV_Target0
{
    float albedo = tgEnergyDirectionalAlbedo(input.uv.x, input.uv.y);
    return float4(tgEnergyTexel(albedo), 0.0, 1.0);
}

float4 ShowPS(TgQuadVarying input) : SV_Target0
{
    float albedo = tgHalvesSum(tex2Dlod(gEnergyAttenuation, float4(input.uv, 0.0, 0.0)).xy);
    return float4(albedo, albedo, albedo, 1.0);
}

#ifdef FX_TECHNIQUES
technique EnergyAttenuation < string Script =
    "RenderColorTarget0=gEnergyAttenuationMap; RenderDepthStencilTarget=; Pass=Precompute;"
    "RenderColorTarget0=; Pass=Show;"; >
{
    TG_QUAD_PASS(Precompute, TgQuadVS, EnergyAttenuationPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Show, TgQuadVS, ShowPS, TG_STATE_BUFFER)
}
#endif
// SPDX-License-Identifier: MIT
