// OriginalTexture: the mesh with its colour map, unlit. Shows that mesh, texture coordinates and colour space are read as meant.
#include "../hlsl/platform.fxh"
#include "../hlsl/settings.fxh"
#include "../hlsl/workspace.fxh"
#include "passes/annotations.fxh"
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/materials.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("OriginalTexture") > = 0.8;

struct TextureVarying
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
};

TextureVarying TextureVS(TgVertexInput stored)
{
    TgMeshInput input = meshVertex(stored);
    TextureVarying output;
    float4 clip = mul(float4(tgWorldPosition(input.position), 1.0), gViewProjection);
    output.position = TG_HALF_PIXEL(clip, gViewportSize);
    output.uv = input.uv;
    return output;
}

float4 TexturePS(TextureVarying input) : SV_Target0
{
    return float4(tex2D(gSkin, input.uv).rgb, 1.0);
}

#ifdef FX_TECHNIQUES
technique OriginalTexture < string Script = "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Texture;"; >
{
    TG_MESH_PASS(Texture, TextureVS, TexturePS, TG_STATE_SOLID)
}
#endif
// SPDX-License-Identifier: MIT
