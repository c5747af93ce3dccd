// Passes ConvolutionU1..5 and ConvolutionUV1..5: the cascade. Map 1 is the irradiance itself, map k + 1 its blur; gIrradianceUMap lies
// between.
#ifndef TEGUMENT_PASSES_CONVOLUTION_FXH
#define TEGUMENT_PASSES_CONVOLUTION_FXH

Texture2D gIrradianceUMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, TG_SKIN_MAP_FORMAT) >;
Texture2D gIrradiance2Map : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, TG_SKIN_MAP_FORMAT) >;
Texture2D gIrradiance3Map : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, TG_SKIN_MAP_FORMAT) >;
Texture2D gIrradiance4Map : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, TG_SKIN_MAP_FORMAT) >;
Texture2D gIrradiance5Map : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, TG_SKIN_MAP_FORMAT) >;
Texture2D gIrradiance6Map : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, TG_SKIN_MAP_FORMAT) >;
TG_SAMPLER2D(gIrradianceU, POINT, CLAMP);
TG_SAMPLER2D(gIrradiance2, POINT, CLAMP);
TG_SAMPLER2D(gIrradiance3, POINT, CLAMP);
TG_SAMPLER2D(gIrradiance4, POINT, CLAMP);
TG_SAMPLER2D(gIrradiance5, POINT, CLAMP);
TG_SAMPLER2D(gIrradiance6, POINT, CLAMP);

// mm of a texel of the light's map, in the middle of what the light sees; the passes draw no mesh that could tell it for each point.
float shadowTexelOfMesh()
{
    return tgShadowFootprint(tgLightParallel() ? 1.0 : 0.5 * (gLightNear + gLightFar), tgLightSpread());
}

float convolutionIncrement(float sigmaBefore, float sigma, float density)
{
    return tgGaussianIncrement(sigmaBefore, sigma, density, tgGaussianPresent(shadowTexelOfMesh(), density));
}

float4 convolveU(TG_SAMPLER2D_PARAM(map), float2 uv, float sigmaBefore, float sigma)
{
    float4 stretch = tex2Dlod(gStretch, float4(uv, 0.0, 0.0));
    float spacing = tgGaussianSpacing(convolutionIncrement(sigmaBefore, sigma, tgGaussianDensity(stretch).x));
    return tgGaussianConvolve(TG_SAMPLER2D_ARG(map), uv, float2(1.0 / kTgMapSize, 0.0), tgGaussianReach(spacing, stretch));
}

float4 convolveV(TG_SAMPLER2D_PARAM(map), float2 uv, float sigmaBefore, float sigma)
{
    float4 stretch = tex2Dlod(gStretch, float4(uv, 0.0, 0.0));
    float spacing = tgGaussianSpacing(convolutionIncrement(sigmaBefore, sigma, tgGaussianDensity(stretch).y));
    return tgGaussianConvolve(TG_SAMPLER2D_ARG(map), uv, float2(0.0, 1.0 / kTgMapSize), tgGaussianReach(spacing, stretch));
}

// Width that map 1 counts for: the paper takes it for the first Gaussian, corrected for what it is, unblurred.
float firstSigma()
{
    return kTgConvolveExactly ? 0.0 : gaussianWidth(0);
}

// One step of the cascade: the map along U into gIrradianceUMap, that along V into the next map. Widths before and after, mm.
#define CASCADE_STEP(number, map, sigmaBefore, sigma) \
float4 ConvolutionU##number##PS(TgQuadVarying input) : SV_Target0 \
{ \
    return convolveU(TG_SAMPLER2D_ARG(map), input.uv, sigmaBefore, sigma); \
} \
float4 ConvolutionUV##number##PS(TgQuadVarying input) : SV_Target0 \
{ \
    return convolveV(TG_SAMPLER2D_ARG(gIrradianceU), input.uv, sigmaBefore, sigma); \
}

CASCADE_STEP(1, gIrradiance, firstSigma(), gaussianWidth(1))
CASCADE_STEP(2, gIrradiance2, gaussianWidth(1), gaussianWidth(2))
CASCADE_STEP(3, gIrradiance3, gaussianWidth(2), gaussianWidth(3))
CASCADE_STEP(4, gIrradiance4, gaussianWidth(3), gaussianWidth(4))
CASCADE_STEP(5, gIrradiance5, gaussianWidth(4), gaussianWidth(5))

#define CASCADE_SCRIPT \
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU1;" \
    "RenderColorTarget0=gIrradiance2Map; Clear=Color; Pass=ConvolutionUV1;" \
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU2;" \
    "RenderColorTarget0=gIrradiance3Map; Clear=Color; Pass=ConvolutionUV2;" \
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU3;" \
    "RenderColorTarget0=gIrradiance4Map; Clear=Color; Pass=ConvolutionUV3;" \
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU4;" \
    "RenderColorTarget0=gIrradiance5Map; Clear=Color; Pass=ConvolutionUV4;" \
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU5;" \
    "RenderColorTarget0=gIrradiance6Map; Clear=Color; Pass=ConvolutionUV5;"
#define CASCADE_PASSES(states) \
    TG_QUAD_PASS(ConvolutionU1, TgQuadVS, ConvolutionU1PS, states) \
    TG_QUAD_PASS(ConvolutionUV1, TgQuadVS, ConvolutionUV1PS, states) \
    TG_QUAD_PASS(ConvolutionU2, TgQuadVS, ConvolutionU2PS, states) \
    TG_QUAD_PASS(ConvolutionUV2, TgQuadVS, ConvolutionUV2PS, states) \
    TG_QUAD_PASS(ConvolutionU3, TgQuadVS, ConvolutionU3PS, states) \
    TG_QUAD_PASS(ConvolutionUV3, TgQuadVS, ConvolutionUV3PS, states) \
    TG_QUAD_PASS(ConvolutionU4, TgQuadVS, ConvolutionU4PS, states) \
    TG_QUAD_PASS(ConvolutionUV4, TgQuadVS, ConvolutionUV4PS, states) \
    TG_QUAD_PASS(ConvolutionU5, TgQuadVS, ConvolutionU5PS, states) \
    TG_QUAD_PASS(ConvolutionUV5, TgQuadVS, ConvolutionUV5PS, states)

#endif
// SPDX-License-Identifier: MIT
