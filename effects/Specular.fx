// Specular: the light that the surface reflects, alone, on the mesh. Techniques: Specular, shadowed, with the normal map; SpecularUnshadowed, as
// Gosselin's Final in setting seed has it; SpecularSmooth, shadowed, with the normals of the mesh.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/specular.fxh"
#include "../hlsl/shadow.fxh"
#include "passes/materials.fxh"
#include "passes/skin_parameters.fxh"
#include "passes/shadow_map.fxh"
#include "passes/surface.fxh"
#include "passes/specular.fxh"

float Script : STANDARDSGLOBAL <
    string UIWidget = "none";
    string ScriptClass = "object";
    string ScriptOrder = "standard";
    string ScriptOutput = "color";
    string WithoutUvs = "*";
    string Script = "Technique=Specular;";
> = 0.8;

SurfaceVarying SpecularVS(MeshInput input)
{
    SurfaceVarying output = surfaceVarying(input);
    output.position = HALF_PIXEL(mul(float4(output.world, 1.0), gViewProjection), gViewportSize);
    return output;
}

float4 reflected(SurfaceVarying input, LitPoint p)
{
    p.scatters = tex2D(gSkin, input.uv).a;
    return float4(reflectedLight(p, safeNormalize(gCameraPosition - input.world)), 1.0);
}

float4 SpecularPS(SurfaceVarying input) : SV_Target0
{
    LitPoint p = surfacePoint(input);
    p.shadow = surfaceShadow(SAMPLER2D_ARG(gShadow), p);
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
    p.shadow = surfaceShadow(SAMPLER2D_ARG(gShadow), p);
    return reflected(input, p);
}

#ifdef FX_TECHNIQUES
technique Specular < string Script =
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;"
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Specular;"; >
{
    MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, STATE_TWOSIDED)
    MESH_PASS(Specular, SpecularVS, SpecularPS, STATE_SOLID)
}

technique SpecularUnshadowed < string Script = "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Specular;"; >
{
    MESH_PASS(Specular, SpecularVS, SpecularUnshadowedPS, STATE_SOLID)
}

technique SpecularSmooth < string Script =
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;"
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Specular;"; >
{
    MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, STATE_TWOSIDED)
    MESH_PASS(Specular, SpecularVS, SpecularSmoothPS, STATE_SOLID)
}
#endif
