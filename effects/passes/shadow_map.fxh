// Pass ShadowMap: depth of the mesh seen from the light into gShadowMap. R32F, because one step of a half is 0.5 mm at 600 mm.
#ifndef TEGUMENT_PASSES_SHADOW_MAP_FXH
#define TEGUMENT_PASSES_SHADOW_MAP_FXH

Texture2D gShadowMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_SHADOW_SIZE, "R32F") bool Keeps = true; >;
Texture2D gShadowDepthMap : RENDERDEPTHSTENCILTARGET < SQUARE_DEPTH(TEGUMENT_SHADOW_SIZE) >;
TG_SAMPLER2D(gShadow, POINT, CLAMP);

#define SHADOW_MAP_SCRIPT \
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;" \
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;"
#define SHADOW_MAP_PASS TG_MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, TG_STATE_TWOSIDED)

struct ShadowVarying
{
    float4 position : SV_Position;
    float3 toLight : TEXCOORD0; // mm
    float4 lightClip : TEXCOORD1;
};

ShadowVarying ShadowMapVS(TgVertexInput stored)
{
    TgMeshInput input = meshVertex(stored);
    ShadowVarying output;
    float3 world = tgWorldPosition(input.position);
    output.lightClip = mul(float4(world, 1.0), gLightViewProjection);
    output.position = TG_HALF_PIXEL(output.lightClip, gViewportSize);
    output.toLight = tgMillimetres(tgLightVector(world));
    return output;
}

float4 ShadowMapPS(ShadowVarying input) : SV_Target0
{
    return float4(tgShadowDepth(input.lightClip, input.toLight), 0.0, 0.0, 1.0);
}

#endif
// SPDX-License-Identifier: MIT
