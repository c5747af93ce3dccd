// Pass TSM: the mesh seen from the light into gTsmMap. A32B32G32R32F, because one step of a half is 0.5 mm at 600 mm.
#ifndef TEGUMENT_PASSES_TSM_FXH
#define TEGUMENT_PASSES_TSM_FXH

Texture2D gTsmMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_SHADOW_SIZE, "A32B32G32R32F") >;
Texture2D gTsmDepthMap : RENDERDEPTHSTENCILTARGET < SQUARE_DEPTH(TEGUMENT_SHADOW_SIZE) >;
TG_SAMPLER2D(gTsm, POINT, CLAMP);

#define TSM_SCRIPT \
    "RenderColorTarget0=gTsmMap; RenderDepthStencilTarget=gTsmDepthMap;" \
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=TSM;"
#define TSM_PASS TG_MESH_PASS(TSM, TsmVS, TsmPS, TG_STATE_TWOSIDED)

struct TsmVarying
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
    float3 toLight : TEXCOORD1; // mm
    float4 lightClip : TEXCOORD2;
};

TsmVarying TsmVS(TgVertexInput stored)
{
    TgMeshInput input = meshVertex(stored);
    TsmVarying output;
    float3 world = tgWorldPosition(input.position);
    output.lightClip = mul(float4(world, 1.0), gLightViewProjection);
    output.position = TG_HALF_PIXEL(output.lightClip, gViewportSize);
    output.uv = input.uv;
    output.toLight = tgMillimetres(tgLightVector(world));
    return output;
}

float4 TsmPS(TsmVarying input) : SV_Target0
{
    return float4(tgShadowDepth(input.lightClip, input.toLight), input.uv, 1.0);
}

#endif
// SPDX-License-Identifier: MIT
