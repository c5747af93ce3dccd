// Specular: the light that the surface reflects, alone, on the mesh. Techniques: Specular, shadowed, with the normal map;
// SpecularUnshadowed, as Gosselin's Final in setting seed has it; SpecularSmooth, shadowed, with the normals of the mesh.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/specular.fxh"
#include "../hlsl/light.fxh"
#include "../hlsl/shadow.fxh"
#include "passes/annotations.fxh"
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/quad.fxh"
#include "passes/materials.fxh"
#include "passes/skin_parameters.fxh"
#include "passes/shadow_map.fxh"
#include "passes/lamp_light.fxh"
#include "passes/lamps.fxh"
#include "passes/more_light.fxh"
#include "passes/surface.fxh"
#include "passes/specular.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("Specular") string WithoutUvs = "*"; > = 0.8;

float4 reflected(SurfaceVarying input, LitPoint p)
{
    p.scatters = tex2D(gSkin, input.uv).a;
    return float4(reflectedLight(p, tgSafeNormalize(gCameraPosition - input.world)), 1.0);
}

float4 SpecularPS(SurfaceVarying input) : SV_Target0
{
    LitPoint p = surfacePoint(input);
    p.shadow = surfaceShadow(TG_SAMPLER2D_ARG(gShadow), p);
    return reflected(input, p);
}

float4 SpecularUnshadowedPS(SurfaceVarying input) : SV_Target0
{
    return reflected(input, surfacePoint(input));
}

float4 SpecularSmoothPS(SurfaceVarying input) : SV_Target0
{
    LitPoint p = surfacePoint(input);
    p.normal = p.meshNormal;
    p.shadow = surfaceShadow(TG_SAMPLER2D_ARG(gShadow), p);
    return reflected(input, p);
}

#ifdef FX_TECHNIQUES
technique Specular < string Script =
    SHADOW_MAP_SCRIPT
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Specular;"; >
{
    SHADOW_MAP_PASS
    TG_MESH_PASS(Specular, SurfaceVS, SpecularPS, TG_STATE_SOLID)
}

technique SpecularUnshadowed < string Script = "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Specular;"; >
{
    TG_MESH_PASS(Specular, SurfaceVS, SpecularUnshadowedPS, TG_STATE_SOLID)
}

technique SpecularSmooth < string Script =
    SHADOW_MAP_SCRIPT
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Specular;"; >
{
    SHADOW_MAP_PASS
    TG_MESH_PASS(Specular, SurfaceVS, SpecularSmoothPS, TG_STATE_SOLID)
}
#endif
// SPDX-License-Identifier: MIT
