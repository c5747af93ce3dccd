// Culling: which texels the prepasses spare the later passes, one colour per cause. Above the map, and the view itself, where no cause
// should be seen; below the whole mesh from the eye's side and from behind. Technique PrePass: passes 2 and 3 in the form of the setting.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/surface.fxh"
#include "../hlsl/cull.fxh"
#include "passes/annotations.fxh"
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/quad.fxh"
#include "passes/materials.fxh"
#include "passes/cull.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("PrePass") > = 0.8;

float4 gFrustumColor < UI_COLOUR("Outside the view") > = { 0.02, 0.12, 0.80, 1.0 };
float4 gBackFaceColor < UI_COLOUR("Facing away") > = { 0.85, 0.28, 0.02, 1.0 };
float4 gBlackColor < UI_COLOUR("Black in the colour map") > = { 0.30, 0.03, 0.30, 1.0 };
float3 gMeshCenter : BOUNDINGCENTER < string UIWidget = "None"; >;
float gMeshRadius : BOUNDINGSPHERESIZE < string UIWidget = "None"; >;

Texture2D gCullingMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, "A16B16G16R16F") >;
TG_SAMPLER2D(gCulling, POINT, CLAMP);

struct CauseVarying
{
    CullVarying cull;
    float2 hidden : TEXCOORD4; // of the vertex: outside, facing away
};

struct PanelVarying
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
    float shade : TEXCOORD1;
    float4 clip : TEXCOORD2; // panels of the mesh as a whole: a point in the middle of the view
};

CauseVarying HiddenVS(TgVertexInput stored)
{
    TgMeshInput input = meshVertex(stored);
    CauseVarying output;
    output.cull = cullVarying(input);
    output.cull.position = TG_HALF_PIXEL(tgUnwrapPosition(input.uv, 0.0), gViewportSize);
    output.hidden = float2(outsidePoint(output.cull) ? 1.0 : 0.0, facesAway(output.cull, 0.0) ? 1.0 : 0.0);
    return output;
}

float4 causeColour(float outside, float away)
{
    clip(outside + away > 0.0 ? 1.0 : -1.0);
    return outside > 0.0 ? gFrustumColor : gBackFaceColor;
}

// Per vertex a triangle is culled for the cause of any of its vertices.
float4 HiddenPS(CauseVarying input) : SV_Target0
{
    if (kTgCullPerPixel)
        return causeColour(outsidePoint(input.cull) ? 1.0 : 0.0, facesAway(input.cull, 0.0) ? 1.0 : 0.0);
    return causeColour(input.hidden.x, input.hidden.y);
}

// Drawn at depth 0 with EQUAL, as the passes are that the prepasses spare.
float4 ProcessedPS(TgQuadVarying input) : SV_Target0
{
    return float4(tex2Dlod(gSkin, float4(input.uv, 0.0, 0.0)).rgb, 1.0);
}

// The panel is a quarter of the picture; panel: its middle, clip space. position: -1..1, square.
float4 panelPosition(float2 position, float2 panel, float depth)
{
    float2 square = min(gViewportSize.x, gViewportSize.y) / gViewportSize;
    return TG_HALF_PIXEL(float4(0.5 * position * square + panel, depth, 1.0), gViewportSize);
}

PanelVarying ShowMapVS(TgQuadInput input)
{
    PanelVarying output;
    output.position = panelPosition(input.position.xy, float2(-0.5, 0.5), 0.0);
    output.uv = input.uv;
    output.shade = 1.0;
    output.clip = float4(0.0, 0.0, 0.0, 1.0);
    return output;
}

float shadeOf(TgMeshInput input, float3 toEye)
{
    float3 normal = tgWorldNormal(input.normal);
    return 0.3 + 0.7 * saturate(dot(normal, toEye));
}

PanelVarying ShowViewVS(TgVertexInput stored)
{
    TgMeshInput input = meshVertex(stored);
    PanelVarying output;
    float3 world = tgWorldPosition(input.position);
    output.clip = mul(float4(world, 1.0), gViewProjection);
    output.position = TG_HALF_PIXEL(float4(0.5 * (output.clip.xy + output.clip.w), output.clip.zw), gViewportSize);
    output.uv = input.uv;
    output.shade = shadeOf(input, tgSafeNormalize(gCameraPosition - world));
    return output;
}

// Parallel projection along the view, the whole mesh in the panel; side: 1 from the eye, -1 from behind.
PanelVarying meshPanel(TgMeshInput input, float side, float2 panel)
{
    PanelVarying output;
    float3 right = side * tgSafeNormalize(mul(gViewProjection, float4(1.0, 0.0, 0.0, 0.0)).xyz);
    float3 up = tgSafeNormalize(mul(gViewProjection, float4(0.0, 1.0, 0.0, 0.0)).xyz);
    float3 toEye = cross(right, up);
    float3 p = (tgWorldPosition(input.position) - gMeshCenter) / max(gMeshRadius, 1e-6);
    output.position = panelPosition(float2(dot(p, right), dot(p, up)), panel, 0.5 - 0.5 * dot(p, toEye));
    output.uv = input.uv;
    output.shade = shadeOf(input, toEye);
    output.clip = float4(0.0, 0.0, 0.0, 1.0);
    return output;
}

PanelVarying ShowFrontVS(TgVertexInput input)
{
    return meshPanel(meshVertex(input), 1.0, float2(-0.5, -0.5));
}

PanelVarying ShowBackVS(TgVertexInput input)
{
    return meshPanel(meshVertex(input), -1.0, float2(0.5, -0.5));
}

float4 ShowPS(PanelVarying input) : SV_Target0
{
    clip(tgCullOutside(input.clip) ? -1.0 : 1.0);
    return float4(tex2Dlod(gCulling, float4(input.uv, 0.0, 0.0)).rgb * input.shade, 1.0);
}

#ifdef FX_TECHNIQUES
// The map of causes, then the four panels.
#define CAUSES_SCRIPT \
    UNWRAP_SCRIPT("gCullingMap", "gBlackColor") "Pass=Hidden; Pass=PrePass1; Pass=PrePass2; Pass=Processed;" \
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=ShowMap; Pass=ShowView; Pass=ShowFront; Pass=ShowBack;"
technique PrePass < string Formerly = "ReachDEonLuebke, ReachGosselin"; string Script = CAUSES_SCRIPT; >
{
    TG_MESH_PASS(Hidden, HiddenVS, HiddenPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(PrePass1, PrePass1VS, PrePass1PS, TG_STATE_PREPASS)
    TG_MESH_PASS(PrePass2, PrePass2VS, PrePass2PS, TG_STATE_PREPASS)
    TG_QUAD_PASS(Processed, TgQuadVS, ProcessedPS, TG_STATE_EQUAL)
    TG_QUAD_PASS(ShowMap, ShowMapVS, ShowPS, TG_STATE_BUFFER)
    TG_MESH_PASS(ShowView, ShowViewVS, ShowPS, TG_STATE_SOLID)
    TG_MESH_PASS(ShowFront, ShowFrontVS, ShowPS, TG_STATE_SOLID)
    TG_MESH_PASS(ShowBack, ShowBackVS, ShowPS, TG_STATE_SOLID)
}
#endif
// SPDX-License-Identifier: MIT
