// Prepasses that leave the picture as it is: they spare every texel that a visible pixel draws light from.
// CullNeed, CullTiles, CullReachU and CullReachV find the tiles, PrePass1 and PrePass2 cull the others. The techniques differ in what light
// reaches a visible pixel: d'Eon and Luebke's passes also through the body, Gosselin's only along the map.
#ifndef TEGUMENT_PASSES_REACH_FXH
#define TEGUMENT_PASSES_REACH_FXH

Texture2D gCullNeedMap : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 1;
    string Format = "R16F"; >;
Texture2D gCullTilesMap : RENDERCOLORTARGET < int Width = 64; int Height = 64; int MipLevels = 1; string Format = "A16B16G16R16F"; >;
Texture2D gCullReachUMap : RENDERCOLORTARGET < int Width = 64; int Height = 64; int MipLevels = 1; string Format = "A16B16G16R16F"; >;
Texture2D gCullReachMap : RENDERCOLORTARGET < int Width = 64; int Height = 64; int MipLevels = 1; string Format = "A16B16G16R16F"; >;
TG_SAMPLER2D(gCullNeed, POINT, CLAMP);
TG_SAMPLER2D(gCullTiles, POINT, CLAMP);
TG_SAMPLER2D(gCullReachU, POINT, CLAMP);
TG_SAMPLER2D(gCullReach, POINT, CLAMP);

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

NeedVarying CullNeedVS(TgMeshInput input)
{
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

CullVarying BlurNeedVS(TgMeshInput input)
{
    CullVarying output = cullVarying(input);
    output.position = TG_HALF_PIXEL(tgUnwrapPosition(input.uv, 0.0), gViewportSize);
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

float4 CullReachUPS(QuadVarying input) : SV_Target0
{
    return tgReachAlong(TG_SAMPLER2D_ARG(gCullTiles), input.uv, float2(1.0, 0.0),
        tgReachOfCascade(gGaussianSigma[0], gGaussianSigma[1].xy));
}

float4 CullReachVPS(QuadVarying input) : SV_Target0
{
    return tgReachAlong(TG_SAMPLER2D_ARG(gCullReachU), input.uv, float2(0.0, 1.0),
        tgReachOfCascade(gGaussianSigma[0], gGaussianSigma[1].xy));
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

CullVarying PrePass2ReachVS(TgMeshInput input)
{
    CullVarying output = cullVarying(input);
    output.position = TG_HALF_PIXEL(tgUnwrapPosition(input.uv, 1.0), gViewportSize);
    return output;
}

float4 PrePass2ReachPS(CullVarying input) : SV_Target0
{
    clip(outOfReach(input.uv) ? 1.0 : -1.0);
    return 0.0;
}

#endif
