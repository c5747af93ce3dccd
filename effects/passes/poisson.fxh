// Passes Blur1 to Blur6: the irradiance into gBlurOddMap, that into gBlurEvenMap, and so on. gBlurCount of them run.
#ifndef TEGUMENT_PASSES_POISSON_FXH
#define TEGUMENT_PASSES_POISSON_FXH

Texture2D gBlurOddMap : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 1;
    string Format = TG_SKIN_MAP_FORMAT; >;
Texture2D gBlurEvenMap : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 1;
    string Format = TG_SKIN_MAP_FORMAT; >;
TG_SAMPLER2D(gBlurOdd, POINT, CLAMP);
TG_SAMPLER2D(gBlurEven, POINT, CLAMP);

float2 blurDensity(float2 uv)
{
    if (kTgPoissonStretched)
        return tgGaussianDensity(tex2Dlod(gStretch, float4(uv, 0.0, 0.0)));
    return float2(0.0, 0.0);
}

// before: number of blurs that the map has seen.
float4 blur(TG_SAMPLER2D_PARAM(map), float2 uv, float before)
{
    float4 centre = tex2Dlod(map, float4(uv, 0.0, 0.0));
    float2 radius = tgPoissonRadius(gBlurSize, centre, blurDensity(uv));
    float2 rotation = float2(cos(before * gBlurTurn), sin(before * gBlurTurn));
    return tgPoissonBlur(TG_SAMPLER2D_ARG(map), uv, centre, radius, rotation);
}

float4 Blur1PS(QuadVarying input) : SV_Target0
{
    return blur(TG_SAMPLER2D_ARG(gIrradiance), input.uv, 0.0);
}

float4 Blur2PS(QuadVarying input) : SV_Target0
{
    return blur(TG_SAMPLER2D_ARG(gBlurOdd), input.uv, 1.0);
}

float4 Blur3PS(QuadVarying input) : SV_Target0
{
    return blur(TG_SAMPLER2D_ARG(gBlurEven), input.uv, 2.0);
}

float4 Blur4PS(QuadVarying input) : SV_Target0
{
    return blur(TG_SAMPLER2D_ARG(gBlurOdd), input.uv, 3.0);
}

float4 Blur5PS(QuadVarying input) : SV_Target0
{
    return blur(TG_SAMPLER2D_ARG(gBlurEven), input.uv, 4.0);
}

float4 Blur6PS(QuadVarying input) : SV_Target0
{
    return blur(TG_SAMPLER2D_ARG(gBlurOdd), input.uv, 5.0);
}

#endif
