// Passes ConvolutionU1..5 and ConvolutionUV1..5: the cascade. Map 1 is the irradiance itself, map k + 1 its blur; gIrradianceUMap lies
// between.
#ifndef TEGUMENT_PASSES_CONVOLUTION_FXH
#define TEGUMENT_PASSES_CONVOLUTION_FXH

Texture2D gIrradianceUMap : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 1;
    string Format = TG_SKIN_MAP_FORMAT; >;
Texture2D gIrradiance2Map : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 1;
    string Format = TG_SKIN_MAP_FORMAT; >;
Texture2D gIrradiance3Map : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 1;
    string Format = TG_SKIN_MAP_FORMAT; >;
Texture2D gIrradiance4Map : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 1;
    string Format = TG_SKIN_MAP_FORMAT; >;
Texture2D gIrradiance5Map : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 1;
    string Format = TG_SKIN_MAP_FORMAT; >;
Texture2D gIrradiance6Map : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 1;
    string Format = TG_SKIN_MAP_FORMAT; >;
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
    return kTgConvolveExactly ? 0.0 : gGaussianSigma[0].x;
}

float4 ConvolutionU1PS(QuadVarying input) : SV_Target0
{
    return convolveU(TG_SAMPLER2D_ARG(gIrradiance), input.uv, firstSigma(), gGaussianSigma[0].y);
}

float4 ConvolutionUV1PS(QuadVarying input) : SV_Target0
{
    return convolveV(TG_SAMPLER2D_ARG(gIrradianceU), input.uv, firstSigma(), gGaussianSigma[0].y);
}

float4 ConvolutionU2PS(QuadVarying input) : SV_Target0
{
    return convolveU(TG_SAMPLER2D_ARG(gIrradiance2), input.uv, gGaussianSigma[0].y, gGaussianSigma[0].z);
}

float4 ConvolutionUV2PS(QuadVarying input) : SV_Target0
{
    return convolveV(TG_SAMPLER2D_ARG(gIrradianceU), input.uv, gGaussianSigma[0].y, gGaussianSigma[0].z);
}

float4 ConvolutionU3PS(QuadVarying input) : SV_Target0
{
    return convolveU(TG_SAMPLER2D_ARG(gIrradiance3), input.uv, gGaussianSigma[0].z, gGaussianSigma[0].w);
}

float4 ConvolutionUV3PS(QuadVarying input) : SV_Target0
{
    return convolveV(TG_SAMPLER2D_ARG(gIrradianceU), input.uv, gGaussianSigma[0].z, gGaussianSigma[0].w);
}

float4 ConvolutionU4PS(QuadVarying input) : SV_Target0
{
    return convolveU(TG_SAMPLER2D_ARG(gIrradiance4), input.uv, gGaussianSigma[0].w, gGaussianSigma[1].x);
}

float4 ConvolutionUV4PS(QuadVarying input) : SV_Target0
{
    return convolveV(TG_SAMPLER2D_ARG(gIrradianceU), input.uv, gGaussianSigma[0].w, gGaussianSigma[1].x);
}

float4 ConvolutionU5PS(QuadVarying input) : SV_Target0
{
    return convolveU(TG_SAMPLER2D_ARG(gIrradiance5), input.uv, gGaussianSigma[1].x, gGaussianSigma[1].y);
}

float4 ConvolutionUV5PS(QuadVarying input) : SV_Target0
{
    return convolveV(TG_SAMPLER2D_ARG(gIrradianceU), input.uv, gGaussianSigma[1].x, gGaussianSigma[1].y);
}

#endif
