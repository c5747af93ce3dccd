// Prepasses that leave the picture as it is: they spare every texel that a visible pixel draws light from.
// CullNeed, CullTiles, CullReachU and CullReachV find the tiles, PrePass1 and PrePass2 cull the others. The techniques differ in what light
// reaches a visible pixel: d'Eon and Luebke's passes also through the body, Gosselin's only along the map.
#ifndef TEGUMENT_PASSES_REACH_FXH
#define TEGUMENT_PASSES_REACH_FXH

Texture2D gCullNeedMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, "R16F") >;
Texture2D gCullTilesMap : RENDERCOLORTARGET < SQUARE_TARGET(64, "A16B16G16R16F") >;
Texture2D gCullReachUMap : RENDERCOLORTARGET < SQUARE_TARGET(64, "A16B16G16R16F") >;
Texture2D gCullReachMap : RENDERCOLORTARGET < SQUARE_TARGET(64, "A16B16G16R16F") >;
TG_SAMPLER2D(gCullNeed, POINT, CLAMP);
TG_SAMPLER2D(gCullTiles, POINT, CLAMP);
TG_SAMPLER2D(gCullReachU, POINT, CLAMP);
TG_SAMPLER2D(gCullReach, POINT, CLAMP);

// From the texels that are needed to the tiles from which light reaches them.
#define REACH_SCRIPT \
    "RenderColorTarget0=gCullNeedMap; RenderDepthStencilTarget=; ClearSetColor=gClearInvalid; Clear=Color; Pass=CullNeed;" \
    "RenderColorTarget0=gCullTilesMap; Pass=CullTiles;" \
    "RenderColorTarget0=gCullReachUMap; Pass=CullReachU;" \
    "RenderColorTarget0=gCullReachMap; Pass=CullReachV;"
#define REACH_PASSES(needVS, needPS, alongUPS, alongVPS) \
    TG_MESH_PASS(CullNeed, needVS, needPS, TG_STATE_BUFFER) \
    TG_QUAD_PASS(CullTiles, QuadVS, CullTilesPS, TG_STATE_BUFFER) \
    TG_QUAD_PASS(CullReachU, QuadVS, alongUPS, TG_STATE_BUFFER) \
    TG_QUAD_PASS(CullReachV, QuadVS, alongVPS, TG_STATE_BUFFER)
#define CASCADE_REACH_PASSES REACH_PASSES(CullNeedVS, CullNeedPS, CullReachUPS, CullReachVPS)
#define BLUR_REACH_PASSES REACH_PASSES(BlurNeedVS, BlurNeedPS, BlurReachUPS, BlurReachVPS)

// Points this far (mm) behind the surface nearest to the light still count as places where light enters.
static const float kEntrySlack = 2.0;
// A triangle may face the eye although its interpolated normal does not: N.V down to this counts as visible.
static const float kFacingSlack = 0.25;

struct NeedVarying
{
    CullVarying cull;
    float3 toLight : TEXCOORD4; // mm
    float4 lightClip : TEXCOORD5;
};

NeedVarying CullNeedVS(VertexInput stored)
{
    TgMeshInput input = meshVertex(stored);
    NeedVarying output;
    output.cull = cullVarying(input);
    output.cull.position = TG_HALF_PIXEL(tgUnwrapPosition(input.uv, 0.0), gViewportSize);
    float3 world = tgWorldPosition(input.position);
    output.toLight = tgMillimetres(tgLightVector(world));
    output.lightClip = mul(float4(world, 1.0), gLightViewProjection);
    return output;
}

bool mayShow(CullVarying input)
{
    return !tgCullOutside(input.clip) && !facesAway(input, kFacingSlack);
}

// A texel is needed if it shows, or if light enters there that may pass through to one that shows.
float4 CullNeedPS(NeedVarying input) : SV_Target0
{
    float slack = kTgDepthInMillimetres ? kEntrySlack : kEntrySlack / max(tgMillimetres(gLightFar - gLightNear), kEntrySlack);
    float depth = tgShadowDepth(input.lightClip, input.toLight);
    float lit = tgShadowTest(TG_SAMPLER2D_ARG(gTsm), tgShadowCoordinate(input.lightClip), depth, slack, float2(0.0, 0.0));
    return float4(mayShow(input.cull) || lit > 0.0 ? 1.0 : 0.0, 0.0, 0.0, 1.0);
}

CullVarying BlurNeedVS(VertexInput input)
{
    CullVarying output = cullVarying(meshVertex(input));
    output.position = TG_HALF_PIXEL(tgUnwrapPosition(output.uv, 0.0), gViewportSize);
    return output;
}

float4 BlurNeedPS(CullVarying input) : SV_Target0
{
    return float4(mayShow(input) ? 1.0 : 0.0, 0.0, 0.0, 1.0);
}

float4 CullTilesPS(QuadVarying input) : SV_Target0
{
    return tgReachTile(TG_SAMPLER2D_ARG(gCullNeed), TG_SAMPLER2D_ARG(gStretch), input.uv);
}

float2 reachOfCascade()
{
    return tgReachOfCascade(float4(gaussianWidth(0), gaussianWidth(1), gaussianWidth(2), gaussianWidth(3)),
        float2(gaussianWidth(4), gaussianWidth(5)));
}

float4 CullReachUPS(QuadVarying input) : SV_Target0
{
    return tgReachAlong(TG_SAMPLER2D_ARG(gCullTiles), input.uv, float2(1.0, 0.0), reachOfCascade());
}

float4 CullReachVPS(QuadVarying input) : SV_Target0
{
    return tgReachAlong(TG_SAMPLER2D_ARG(gCullReachU), input.uv, float2(0.0, 1.0), reachOfCascade());
}

float4 BlurReachUPS(QuadVarying input) : SV_Target0
{
    return tgReachAlong(TG_SAMPLER2D_ARG(gCullTiles), input.uv, float2(1.0, 0.0), tgReachOfBlurs(gBlurSize, gBlurCount));
}

float4 BlurReachVPS(QuadVarying input) : SV_Target0
{
    return tgReachAlong(TG_SAMPLER2D_ARG(gCullReachU), input.uv, float2(0.0, 1.0), tgReachOfBlurs(gBlurSize, gBlurCount));
}

bool outOfReach(float2 uv)
{
    return tex2Dlod(gCullReach, float4(uv, 0.0, 0.0)).x < 0.5;
}

float4 PrePass1ReachPS(QuadVarying input) : SV_Target0
{
    clip(outOfReach(input.uv) && blackAround(input.uv) ? 1.0 : -1.0);
    return 0.0;
}

CullVarying PrePass2ReachVS(VertexInput input)
{
    CullVarying output = cullVarying(meshVertex(input));
    output.position = TG_HALF_PIXEL(tgUnwrapPosition(output.uv, 1.0), gViewportSize);
    return output;
}

float4 PrePass2ReachPS(CullVarying input) : SV_Target0
{
    clip(outOfReach(input.uv) ? 1.0 : -1.0);
    return 0.0;
}

#endif
