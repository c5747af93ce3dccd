// Stretch: uv per mm along U and V, precomputed once per mesh, shown as it is stored. Alpha: 0 inside the charts, 1 outside; there the map
// holds the mean over the charts, taken from the last mip level.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/surface.fxh"
#include "passes/annotations.fxh"
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/quad.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("Stretch") > = 0.8;

Texture2D gStretchChartsMap : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 0;
    string Format = "A32B32G32R32F"; >;
Texture2D gStretchMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, "A16B16G16R16F") >;
TG_SAMPLER2D(gStretchCharts, POINT, CLAMP);
TG_SAMPLER2D(gStretch, POINT, CLAMP);

// Beyond any mip chain: selects its last level.
static const float kLastLevel = 20.0;

struct StretchVarying
{
    float4 position : SV_Position;
    float3 world : TEXCOORD0; // mm
};

StretchVarying StretchVS(TgVertexInput stored)
{
    TgMeshInput input = meshVertex(stored);
    StretchVarying output;
    output.position = TG_HALF_PIXEL(tgUnwrapPosition(input.uv, 0.0), gViewportSize);
    output.world = tgMillimetres(tgWorldPosition(input.position));
    return output;
}

float4 StretchPS(StretchVarying input) : SV_Target0
{
    return float4(tgStretchEncode(ddx(input.world), ddy(input.world), kTgMapSize), 0.0, 0.0);
}

float4 FillPS(TgQuadVarying input) : SV_Target0
{
    float4 texel = tex2Dlod(gStretchCharts, float4(input.uv, 0.0, 0.0));
    float4 all = tex2Dlod(gStretchCharts, float4(0.5, 0.5, 0.0, kLastLevel));
    float2 mean = all.xy / max(1.0 - all.w, 1e-6);
    return texel.w < 0.5 ? texel : float4(mean, 0.0, 1.0);
}

float4 ShowPS(TgQuadVarying input) : SV_Target0
{
    float4 texel = tex2Dlod(gStretch, float4(input.uv, 0.0, 0.0));
    return float4(texel.xy * (1.0 - texel.w), 0.0, 1.0);
}

#ifdef FX_TECHNIQUES
technique Stretch < string Script =
    "RenderColorTarget0=gStretchChartsMap; RenderDepthStencilTarget=; ClearSetColor=gClearInvalid; Clear=Color; Pass=Charts;"
    "RenderColorTarget0=gStretchMap; Pass=Fill;"
    "RenderColorTarget0=; Pass=Show;"; >
{
    TG_MESH_PASS(Charts, StretchVS, StretchPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Fill, TgQuadVS, FillPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Show, TgQuadVS, ShowPS, TG_STATE_BUFFER)
}
#endif
// SPDX-License-Identifier: MIT
