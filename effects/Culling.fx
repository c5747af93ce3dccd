// Culling: which texels the prepasses spare the later passes, one colour per cause. Above the map, and the view itself, where no cause
// should be seen; below the whole mesh from the eye's side and from behind. Techniques: PrePass, passes 2 and 3 in the form of the setting;
// ReachDEonLuebke and ReachGosselin, the form that leaves the picture as it is (DEonLuebkeCulled, GosselinCulled).
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/cull.fxh"
#include "passes/quad.fxh"
#include "passes/materials.fxh"
#include "passes/tsm.fxh"
#include "passes/stretch.fxh"
#include "passes/profile.fxh"
#include "passes/blur_parameters.fxh"
#include "passes/cull.fxh"
#include "passes/reach.fxh"

float Script : STANDARDSGLOBAL <
    string UIWidget = "none";
    string ScriptClass = "object";
    string ScriptOrder = "standard";
    string ScriptOutput = "color";
    string Script = "Technique=ReachDEonLuebke;";
> = 0.8;

float4 gFrustumColor < string UIName = "Outside the view"; string UIWidget = "Color"; > = { 0.02, 0.12, 0.80, 1.0 };
float4 gBackFaceColor < string UIName = "Facing away"; string UIWidget = "Color"; > = { 0.85, 0.28, 0.02, 1.0 };
float4 gBlackColor < string UIName = "Black in the colour map"; string UIWidget = "Color"; > = { 0.30, 0.03, 0.30, 1.0 };
float3 gMeshCenter : BOUNDINGCENTER < string UIWidget = "None"; >;
float gMeshRadius : BOUNDINGSPHERESIZE < string UIWidget = "None"; >;

Texture2D gCullingMap : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 1;
    string Format = "A16B16G16R16F"; >;
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

CauseVarying HiddenVS(TgMeshInput input)
{
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

// Whatever the reach does not spare either is outside or faces away.
float4 HiddenReachPS(CauseVarying input) : SV_Target0
{
    return causeColour(tgCullOutside(input.cull.clip) ? 1.0 : 0.0, 1.0);
}

// Drawn at depth 0 with EQUAL, as the passes are that the prepasses spare.
float4 ProcessedPS(QuadVarying input) : SV_Target0
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

PanelVarying ShowViewVS(TgMeshInput input)
{
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

PanelVarying ShowFrontVS(TgMeshInput input)
{
    return meshPanel(input, 1.0, float2(-0.5, -0.5));
}

PanelVarying ShowBackVS(TgMeshInput input)
{
    return meshPanel(input, -1.0, float2(0.5, -0.5));
}

float4 ShowPS(PanelVarying input) : SV_Target0
{
    clip(tgCullOutside(input.clip) ? -1.0 : 1.0);
    return float4(tex2Dlod(gCulling, float4(input.uv, 0.0, 0.0)).rgb * input.shade, 1.0);
}

#ifdef FX_TECHNIQUES
technique PrePass < string Script =
    "RenderColorTarget0=gCullingMap; RenderDepthStencilTarget=gUnwrapDepthMap;"
    "ClearSetColor=gBlackColor; ClearSetDepth=gClearNear; Clear=Color; Clear=Depth;"
    "Pass=Hidden; Pass=PrePass1; Pass=PrePass2; Pass=Processed;"
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=ShowMap; Pass=ShowView; Pass=ShowFront; Pass=ShowBack;"; >
{
    TG_MESH_PASS(Hidden, HiddenVS, HiddenPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(PrePass1, PrePass1VS, PrePass1PS, TG_STATE_PREPASS)
    TG_MESH_PASS(PrePass2, PrePass2VS, PrePass2PS, TG_STATE_PREPASS)
    TG_QUAD_PASS(Processed, QuadVS, ProcessedPS, TG_STATE_EQUAL)
    TG_QUAD_PASS(ShowMap, ShowMapVS, ShowPS, TG_STATE_BUFFER)
    TG_MESH_PASS(ShowView, ShowViewVS, ShowPS, TG_STATE_SOLID)
    TG_MESH_PASS(ShowFront, ShowFrontVS, ShowPS, TG_STATE_SOLID)
    TG_MESH_PASS(ShowBack, ShowBackVS, ShowPS, TG_STATE_SOLID)
}

technique ReachDEonLuebke < string Script =
    "RenderColorTarget0=gTsmMap; RenderDepthStencilTarget=gTsmDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=TSM;"
    "RenderColorTarget0=gCullNeedMap; RenderDepthStencilTarget=; ClearSetColor=gClearInvalid; Clear=Color; Pass=CullNeed;"
    "RenderColorTarget0=gCullTilesMap; Pass=CullTiles; RenderColorTarget0=gCullReachUMap; Pass=CullReachU;"
    "RenderColorTarget0=gCullReachMap; Pass=CullReachV;"
    "RenderColorTarget0=gCullingMap; RenderDepthStencilTarget=gUnwrapDepthMap;"
    "ClearSetColor=gBlackColor; ClearSetDepth=gClearNear; Clear=Color; Clear=Depth;"
    "Pass=Hidden; Pass=PrePass1; Pass=PrePass2; Pass=Processed;"
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=ShowMap; Pass=ShowView; Pass=ShowFront; Pass=ShowBack;"; >
{
    TG_MESH_PASS(TSM, TsmVS, TsmPS, TG_STATE_TWOSIDED)
    TG_MESH_PASS(CullNeed, CullNeedVS, CullNeedPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(CullTiles, QuadVS, CullTilesPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(CullReachU, QuadVS, CullReachUPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(CullReachV, QuadVS, CullReachVPS, TG_STATE_BUFFER)
    TG_MESH_PASS(Hidden, HiddenVS, HiddenReachPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(PrePass1, PrePass1VS, PrePass1ReachPS, TG_STATE_PREPASS)
    TG_MESH_PASS(PrePass2, PrePass2ReachVS, PrePass2ReachPS, TG_STATE_PREPASS)
    TG_QUAD_PASS(Processed, QuadVS, ProcessedPS, TG_STATE_EQUAL)
    TG_QUAD_PASS(ShowMap, ShowMapVS, ShowPS, TG_STATE_BUFFER)
    TG_MESH_PASS(ShowView, ShowViewVS, ShowPS, TG_STATE_SOLID)
    TG_MESH_PASS(ShowFront, ShowFrontVS, ShowPS, TG_STATE_SOLID)
    TG_MESH_PASS(ShowBack, ShowBackVS, ShowPS, TG_STATE_SOLID)
}

technique ReachGosselin < string Script =
    "RenderColorTarget0=gCullNeedMap; RenderDepthStencilTarget=; ClearSetColor=gClearInvalid; Clear=Color; Pass=CullNeed;"
    "RenderColorTarget0=gCullTilesMap; Pass=CullTiles; RenderColorTarget0=gCullReachUMap; Pass=CullReachU;"
    "RenderColorTarget0=gCullReachMap; Pass=CullReachV;"
    "RenderColorTarget0=gCullingMap; RenderDepthStencilTarget=gUnwrapDepthMap;"
    "ClearSetColor=gBlackColor; ClearSetDepth=gClearNear; Clear=Color; Clear=Depth;"
    "Pass=Hidden; Pass=PrePass1; Pass=PrePass2; Pass=Processed;"
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=ShowMap; Pass=ShowView; Pass=ShowFront; Pass=ShowBack;"; >
{
    TG_MESH_PASS(CullNeed, BlurNeedVS, BlurNeedPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(CullTiles, QuadVS, CullTilesPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(CullReachU, QuadVS, BlurReachUPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(CullReachV, QuadVS, BlurReachVPS, TG_STATE_BUFFER)
    TG_MESH_PASS(Hidden, HiddenVS, HiddenReachPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(PrePass1, PrePass1VS, PrePass1ReachPS, TG_STATE_PREPASS)
    TG_MESH_PASS(PrePass2, PrePass2ReachVS, PrePass2ReachPS, TG_STATE_PREPASS)
    TG_QUAD_PASS(Processed, QuadVS, ProcessedPS, TG_STATE_EQUAL)
    TG_QUAD_PASS(ShowMap, ShowMapVS, ShowPS, TG_STATE_BUFFER)
    TG_MESH_PASS(ShowView, ShowViewVS, ShowPS, TG_STATE_SOLID)
    TG_MESH_PASS(ShowFront, ShowFrontVS, ShowPS, TG_STATE_SOLID)
    TG_MESH_PASS(ShowBack, ShowBackVS, ShowPS, TG_STATE_SOLID)
}
#endif
