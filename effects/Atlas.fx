// Atlas: what lighting in texture space needs of the mesh, drawn once per mesh and pose: place and normals in the mesh's own space, and the
// metric of its texels. Shown: texels per mm. Passes that light it are full-screen passes, and draw no triangle.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/surface.fxh"
#include "passes/annotations.fxh"
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/quad.fxh"
#include "passes/materials.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("Atlas") > = 0.8;

Texture2D gNormalMap : NORMAL < float4 Fallback = { 0.5, 0.5, 1.0, 1.0 }; string UIName = "Normal map"; >;
TG_SAMPLER2D(gNormal, LINEAR, CLAMP);

Texture2D gAtlasPositionMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, "A32B32G32R32F") >;
Texture2D gAtlasNormalMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, "A16B16G16R16F") >;
Texture2D gAtlasMeshNormalMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, "A16B16G16R16F") >;
Texture2D gAtlasTangentMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, "A16B16G16R16F") >;
Texture2D gAtlasChartsMap : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 0;
    string Format = "A32B32G32R32F"; >;
Texture2D gAtlasMetricMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, "A16B16G16R16F") >;
TG_SAMPLER2D(gAtlasCharts, POINT, CLAMP);
TG_SAMPLER2D(gAtlasMetric, POINT, CLAMP);

// Levels of the chart's mip chain that are looked through for the density around a gap; beyond any chain: its last level.
static const int kGapLevels = 4;
static const float kLastLevel = 20.0;
// Cells along a side, and the level of the chain that has so many.
static const float kSmoothCells = 128.0;
static const float kSmoothLevel = log2(max(TEGUMENT_MAP_SIZE / kSmoothCells, 1.0));
// Texels of this size (mm) are shown white.
static const float kShownTexel = 0.1;

struct AtlasVarying
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
    float3 place : TEXCOORD1; // mesh space
    float3 normal : TEXCOORD2;
    float4 tangent : TEXCOORD3;
    float3 world : TEXCOORD4; // mm
};

AtlasVarying AtlasVS(TgVertexInput stored)
{
    TgMeshInput input = meshVertex(stored);
    AtlasVarying output;
    output.position = TG_HALF_PIXEL(tgUnwrapPosition(input.uv, 0.0), gViewportSize);
    output.uv = input.uv;
    output.place = input.position;
    output.normal = input.normal;
    output.tangent = input.tangent;
    output.world = tgMillimetres(tgWorldPosition(input.position));
    return output;
}

float4 PositionPS(AtlasVarying input) : SV_Target0
{
    return float4(input.place, 1.0);
}

// With the normal map; alpha: 1 skin, 0 plain material.
float4 NormalPS(AtlasVarying input) : SV_Target0
{
    float3 normal = tgSurfaceNormal(input.normal, input.tangent, tex2D(gNormal, input.uv).xyz);
    return float4(normal, step(0.5, tex2D(gSkin, input.uv).a));
}

float4 MeshNormalPS(AtlasVarying input) : SV_Target0
{
    return float4(tgSafeNormalize(input.normal), 1.0);
}

// Alpha: its sign.
float4 TangentPS(AtlasVarying input) : SV_Target0
{
    return float4(tgSafeNormalize(input.tangent.xyz), input.tangent.w < 0.0 ? -1.0 : 1.0);
}

float4 ChartsPS(AtlasVarying input) : SV_Target0
{
    return float4(tgMetric(ddx(input.world), ddy(input.world)), 1.0);
}

// The density of what lies around, evenly weighed down over two cells of a grid of 128 x 128: from facet to facet it jumps, and levels of a
// pyramid that were weighed by different ones would not sum to the light. 0: nothing near is covered.
float smoothDensity(float2 uv)
{
    float2 cell = floor(uv * kSmoothCells);
    float2 sum = 0.0;
    [unroll] for (int j = -2; j <= 2; j++)
        [unroll] for (int i = -2; i <= 2; i++)
        {
            float2 at = (cell + float2(i, j) + 0.5) / kSmoothCells;
            float2 share = saturate(1.0 - abs(at - uv) * (0.5 * kSmoothCells));
            sum += share.x * share.y * tex2Dlod(gAtlasCharts, float4(at, 0.0, kSmoothLevel)).zw;
        }
    return sum.y > 0.0 ? sum.x / max(sum.y, 1e-6) : 0.0;
}

// Outside the charts: the density of what is near, round.
float4 MetricPS(TgQuadVarying input) : SV_Target0
{
    float4 texel = tex2Dlod(gAtlasCharts, float4(input.uv, 0.0, 0.0));
    [unroll] for (int level = 1; level <= kGapLevels; level++)
    {
        float4 wide = tex2Dlod(gAtlasCharts, float4(input.uv, 0.0, level));
        if (texel.w < 0.5 && wide.w > 0.0)
            texel = float4(0.0, 0.0, wide.z / max(wide.w, 1e-6), 1.0);
    }
    float smooth = smoothDensity(input.uv);
    texel.z = smooth > 0.0 ? smooth : texel.z;
    float4 all = tex2Dlod(gAtlasCharts, float4(0.5, 0.5, 0.0, kLastLevel));
    return texel.w > 0.5 ? texel : float4(0.0, 0.0, all.z / max(all.w, 1e-6), 0.0);
}

float4 ShowPS(TgQuadVarying input) : SV_Target0
{
    float density = sqrt(tex2Dlod(gAtlasMetric, float4(input.uv, 0.0, 0.0)).z);
    return float4(float3(1.0, 1.0, 1.0) * density * kShownTexel, 1.0);
}

#ifdef FX_TECHNIQUES
technique Atlas < string Script =
    "RenderColorTarget0=gAtlasPositionMap; RenderDepthStencilTarget=; ClearSetColor=gClearEmpty; Clear=Color; Pass=Position;"
    "RenderColorTarget0=gAtlasNormalMap; Clear=Color; Pass=Normal;"
    "RenderColorTarget0=gAtlasMeshNormalMap; Clear=Color; Pass=MeshNormal;"
    "RenderColorTarget0=gAtlasTangentMap; Clear=Color; Pass=Tangent;"
    "RenderColorTarget0=gAtlasChartsMap; Clear=Color; Pass=Charts;"
    "RenderColorTarget0=gAtlasMetricMap; Pass=Metric;"
    "RenderColorTarget0=; Pass=Show;"; >
{
    TG_MESH_PASS(Position, AtlasVS, PositionPS, TG_STATE_BUFFER)
    TG_MESH_PASS(Normal, AtlasVS, NormalPS, TG_STATE_BUFFER)
    TG_MESH_PASS(MeshNormal, AtlasVS, MeshNormalPS, TG_STATE_BUFFER)
    TG_MESH_PASS(Tangent, AtlasVS, TangentPS, TG_STATE_BUFFER)
    TG_MESH_PASS(Charts, AtlasVS, ChartsPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Metric, TgQuadVS, MetricPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Show, TgQuadVS, ShowPS, TG_STATE_BUFFER)
}
#endif
// SPDX-License-Identifier: MIT
