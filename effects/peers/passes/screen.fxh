// Passes Light and Final of diffusion over the pixels of the picture. Light: light entering the skin as the camera sees it, with coverage
// in alpha; depth along the view, mm, 0 where there is no skin; shadow, for the specular reflection, and the depth once more as two halves,
// to be filtered. Final: the mesh once more, over what the effect has made of it in gScatterMap.
#ifndef TEGUMENT_PEERS_PASSES_SCREEN_FXH
#define TEGUMENT_PEERS_PASSES_SCREEN_FXH

float4x4 gProjection : PROJECTION < string UIWidget = "None"; >;

Texture2D gLightMap : RENDERCOLORTARGET < PICTURE_TARGET("A16B16G16R16F") >;
Texture2D gDepthMap : RENDERCOLORTARGET < PICTURE_TARGET("R32F") >;
Texture2D gShadeMap : RENDERCOLORTARGET < PICTURE_TARGET("A16B16G16R16F") >;
Texture2D gScatterMap : RENDERCOLORTARGET < PICTURE_TARGET("A16B16G16R16F") >;
Texture2D gLightDepthMap : RENDERDEPTHSTENCILTARGET < PICTURE_DEPTH >;
TG_SAMPLER2D(gLight, LINEAR, CLAMP);
TG_SAMPLER2D(gDepth, POINT, CLAMP);
TG_SAMPLER2D(gShade, POINT, CLAMP);
TG_SAMPLER2D(gScatter, POINT, CLAMP);

// What comes before and what after an effect's own passes, which lead from gLightMap to gScatterMap.
#define LIGHT_SCRIPT \
    LAMPS_SCRIPT SHADOW_MAP_SCRIPT \
    "RenderColorTarget0=gLightMap; RenderColorTarget1=gDepthMap; RenderColorTarget2=gShadeMap; RenderDepthStencilTarget=gLightDepthMap;" \
    "Clear=Color; Clear=Depth; Pass=Light;" \
    "RenderColorTarget1=; RenderColorTarget2=; RenderDepthStencilTarget=;"
#define LIGHT_PASSES \
    LAMPS_PASSES \
    SHADOW_MAP_PASS \
    TG_MESH_PASS(Light, SurfaceVS, LightPS, TG_STATE_SOLID)
#define SCATTERED_SCRIPT "RenderColorTarget0=; Pass=Final;"
#define SCATTERED_PASS TG_MESH_PASS(Final, SurfaceVS, ScreenFinalPS, TG_STATE_SOLID)

struct LightOutput
{
    float4 light : SV_Target0;
    float4 depth : SV_Target1;
    float4 shade : SV_Target2;
};

LightOutput LightPS(SurfaceVarying input)
{
    LitPoint p = peerPoint(input);
    p.shadow = surfaceShadow(TG_SAMPLER2D_ARG(gShadow), p);
    float skin = step(0.5, p.scatters);
    float depth = tgMillimetres(mul(float4(input.world, 1.0), gViewProjection).w);
    LightOutput output;
    output.light = float4(skin * tgIrradianceBounded(enteringLight(p), kTgLargestHalf), skin);
    output.depth = float4(skin * depth, 0.0, 0.0, 1.0);
    output.shade = float4(p.shadow, skin * tgHalvesOf(min(depth, kTgFarthestHalf), tgScreenDepthStep(depth)), 1.0);
    return output;
}

float2 pictureCoordinate(float3 world)
{
    float4 clip = mul(float4(world, 1.0), gViewProjection);
    return clip.xy / max(clip.w, 1e-6) * float2(0.5, -0.5) + 0.5;
}

float4 ScreenFinalPS(SurfaceVarying input) : SV_Target0
{
    float2 uv = pictureCoordinate(input.world);
    LitPoint p = peerPoint(input);
    p.shadow = tex2Dlod(gShade, float4(uv, 0.0, 0.0)).x;
    return peerRadiance(input, p, tex2Dlod(gScatter, float4(uv, 0.0, 0.0)).rgb);
}

#endif
// SPDX-License-Identifier: MIT
