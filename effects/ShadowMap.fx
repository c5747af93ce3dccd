// ShadowMap: depth of the surface nearest to the light, shown between the light's planes; technique Shadow shows what it shades on the
// mesh.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/light.fxh"
#include "passes/annotations.fxh"
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/quad.fxh"
#include "passes/skin_parameters.fxh"
#include "passes/shadow_map.fxh"
#include "passes/lamp_light.fxh"
#include "passes/lamps.fxh"
#include "passes/more_light.fxh"
#include "passes/surface.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("ShadowMap") > = 0.8;

// Nearest white, farthest black, black where there is no surface.
float4 ShowPS(TgQuadVarying input) : SV_Target0
{
    float texel = tgShadowStored(tex2Dlod(gShadow, float4(input.uv, 0.0, 0.0))).x;
    float depth = kTgDepthInMillimetres ? (texel - tgMillimetres(gLightNear)) / max(tgMillimetres(gLightFar - gLightNear), 1e-6) : texel;
    return float4(float3(1.0, 1.0, 1.0) * saturate(1.0 - depth), 1.0);
}

float4 ShadowPS(SurfaceVarying input) : SV_Target0
{
    LitPoint p = surfacePoint(input);
    return float4(float3(1.0, 1.0, 1.0) * surfaceShadow(TG_SAMPLER2D_ARG(gShadow), p), 1.0);
}

#ifdef FX_TECHNIQUES
technique ShadowMap < string Script =
    SHADOW_MAP_SCRIPT
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Show;"; >
{
    SHADOW_MAP_PASS
    TG_QUAD_PASS(Show, TgQuadVS, ShowPS, TG_STATE_BUFFER)
}

technique Shadow < string Script =
    SHADOW_MAP_SCRIPT
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Shadow;"; >
{
    SHADOW_MAP_PASS
    TG_MESH_PASS(Shadow, SurfaceVS, ShadowPS, TG_STATE_SOLID)
}
#endif
// SPDX-License-Identifier: MIT
