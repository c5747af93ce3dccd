// Passes PrePass1 and PrePass2: depth 1 in the texture-space depth target where nothing needs to be drawn. The script clears it to 0 in any case.
// Setting corrected: four passes before them find the tiles that the picture draws light from: CullNeed, CullTiles, CullReachU, CullReachV.
#ifndef TEGUMENT_PASSES_CULL_FXH
#define TEGUMENT_PASSES_CULL_FXH

Texture2D gUnwrapDepthMap : RENDERDEPTHSTENCILTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; string Format = "D24S8"; >;
Texture2D gCullNeedMap : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 1; string Format = "A16B16G16R16F"; >;
Texture2D gCullTilesMap : RENDERCOLORTARGET < int Width = 64; int Height = 64; int MipLevels = 1; string Format = "A16B16G16R16F"; >;
Texture2D gCullReachUMap : RENDERCOLORTARGET < int Width = 64; int Height = 64; int MipLevels = 1; string Format = "A16B16G16R16F"; >;
Texture2D gCullReachMap : RENDERCOLORTARGET < int Width = 64; int Height = 64; int MipLevels = 1; string Format = "A16B16G16R16F"; >;
SAMPLER2D(gCullNeed, POINT, CLAMP);
SAMPLER2D(gCullTiles, POINT, CLAMP);
SAMPLER2D(gCullReachU, POINT, CLAMP);
SAMPLER2D(gCullReach, POINT, CLAMP);

struct CullVarying
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
    float4 clip : TEXCOORD1;
    float3 world : TEXCOORD2;
    float3 normal : TEXCOORD3;
    float4 lightClip : TEXCOORD4;
};

// Points this far (mm) behind the surface nearest to the light still count as places where light enters.
static const float kEntrySlack = 2.0;

CullVarying CullNeedVS(MeshInput input)
{
    CullVarying output;
    output.world = worldPosition(input.position);
    output.clip = mul(float4(output.world, 1.0), gViewProjection);
    output.lightClip = mul(float4(output.world, 1.0), gLightViewProjection);
    output.normal = mul(input.normal, (float3x3)gWorldInverseTranspose);
    output.position = HALF_PIXEL(unwrapPosition(input.uv, 0.0), gViewportSize);
    output.uv = input.uv;
    return output;
}

// A texel is needed if it shows, or if light enters there that may pass through to one that shows.
float4 CullNeedPS(CullVarying input) : SV_Target0
{
    bool hidden = cullHidden(input.clip, safeNormalize(input.normal), safeNormalize(gCameraPosition - input.world));
    float depth = tsmDepth(input.lightClip, input.world - gLightPosition);
    float lit = tsmShadow(SAMPLER2D_ARG(gTsm), tsmCoordinate(input.lightClip), depth, kEntrySlack, float2(0.0, 0.0));
    return float4(!hidden || lit > 0.0 ? 1.0 : 0.0, gaussianDensity(tex2Dlod(gStretch, float4(input.uv, 0.0, 0.0))), 1.0);
}

float4 CullTilesPS(QuadVarying input) : SV_Target0
{
    return reachTile(SAMPLER2D_ARG(gCullNeed), input.uv);
}

float4 CullReachUPS(QuadVarying input) : SV_Target0
{
    return reachAlong(SAMPLER2D_ARG(gCullTiles), input.uv, float2(1.0, 0.0), reachOfCascade(gGaussianSigma[0], gGaussianSigma[1].xy));
}

float4 CullReachVPS(QuadVarying input) : SV_Target0
{
    return reachAlong(SAMPLER2D_ARG(gCullReachU), input.uv, float2(0.0, 1.0), reachOfCascade(gGaussianSigma[0], gGaussianSigma[1].xy));
}

bool outOfReach(float2 uv)
{
    return tex2Dlod(gCullReach, float4(uv, 0.0, 0.0)).x < 0.5;
}

// A black texel survives while a coloured one is this near (texels): the seams' repair writes there.
static const float kRepairRadius = 2.0;

bool blackAround(float2 uv)
{
    bool black = true;
    [unroll] for (int j = -1; j <= 1; j++)
        [unroll] for (int i = -1; i <= 1; i++)
            black = black && cullBlack(tex2Dlod(gSkin, float4(uv + float2(i, j) * kRepairRadius / kMapSize, 0.0, 0.0)).rgb);
    return black;
}

QuadVarying PrePass1VS(QuadInput input)
{
    QuadVarying output = QuadVS(input);
    output.position.z = 1.0;
    return output;
}

float4 PrePass1PS(QuadVarying input) : SV_Target0
{
    bool dead = blackAround(input.uv) && (!kCullByReach || outOfReach(input.uv));
    clip(dead ? 1.0 : -1.0);
    return 0.0;
}

// Setting seed culls whole vertices, by their depth; corrected culls texels.
CullVarying PrePass2VS(MeshInput input)
{
    CullVarying output = CullNeedVS(input);
    bool hidden = cullHidden(output.clip, safeNormalize(output.normal), safeNormalize(gCameraPosition - output.world));
    output.position = HALF_PIXEL(unwrapPosition(input.uv, kCullByReach || hidden ? 1.0 : 0.0), gViewportSize);
    return output;
}

float4 PrePass2PS(CullVarying input) : SV_Target0
{
    clip(!kCullByReach || outOfReach(input.uv) ? 1.0 : -1.0);
    return 0.0;
}

#endif
