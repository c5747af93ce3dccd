// Passes Blur1 to Blur6: the irradiance into gBlurOddMap, that into gBlurEvenMap, and so on. gBlurCount of them run.
#ifndef TEGUMENT_PASSES_POISSON_FXH
#define TEGUMENT_PASSES_POISSON_FXH

Texture2D gBlurOddMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, TG_SKIN_MAP_FORMAT) >;
Texture2D gBlurEvenMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, TG_SKIN_MAP_FORMAT) >;
TG_SAMPLER2D(gBlurOdd, POINT, CLAMP);
TG_SAMPLER2D(gBlurEven, POINT, CLAMP);

float2 blurDensity(float2 uv)
{
    if (kTgPoissonStretched)
        return tgGaussianDensity(tex2Dlod(gStretch, float4(uv, 0.0, 0.0)));
    return float2(0.0, 0.0);
}

float4 tgPoissonBlur(TG_SAMPLER2D_PARAM(map), float2 uv, float before)
{
    float4 centre = tex2Dlod(map, float4(uv, 0.0, 0.0));
    float2 radius = tgPoissonRadius(gBlurSize, centre, blurDensity(uv));
    float2 rotation = float2(cos(before * gBlurTurn), sin(before * gBlurTurn));
    return tgPoissonBlur(TG_SAMPLER2D_ARG(map), uv, centre, radius, rotation);
}

// before: number of blurs that the map has seen.
#define BLUR_STEP(number, map, before) \
float4 Blur##number##PS(TgQuadVarying input) : SV_Target0 \
{ \
    return tgPoissonBlur(TG_SAMPLER2D_ARG(map), input.uv, before); \
}

BLUR_STEP(1, gIrradiance, 0.0)
BLUR_STEP(2, gBlurOdd, 1.0)
BLUR_STEP(3, gBlurEven, 2.0)
BLUR_STEP(4, gBlurOdd, 3.0)
BLUR_STEP(5, gBlurEven, 4.0)
BLUR_STEP(6, gBlurOdd, 5.0)

#define BLURS_SCRIPT \
    "LoopByCount=gBlurCount; LoopGetIndex=gBlurIndex;" \
    "RenderColorTarget0=gBlurIndex?gBlurOddMap:gBlurEvenMap:gBlurOddMap:gBlurEvenMap:gBlurOddMap:gBlurEvenMap; Clear=Color;" \
    "Pass=gBlurIndex?Blur1:Blur2:Blur3:Blur4:Blur5:Blur6; LoopEnd;"
// The pass that reads what the last blur has left: in gBlurOddMap or in gBlurEvenMap. Strings.
#define BLURRED_SCRIPT(odd, even) "Pass=gBlurIndex?" odd ":" even ":" odd ":" even ":" odd ":" even ";"
#define BLUR_PASSES_1_TO_3(states) \
    TG_QUAD_PASS(Blur1, TgQuadVS, Blur1PS, states) \
    TG_QUAD_PASS(Blur2, TgQuadVS, Blur2PS, states) \
    TG_QUAD_PASS(Blur3, TgQuadVS, Blur3PS, states)
#define BLUR_PASSES_4_TO_6(states) \
    TG_QUAD_PASS(Blur4, TgQuadVS, Blur4PS, states) \
    TG_QUAD_PASS(Blur5, TgQuadVS, Blur5PS, states) \
    TG_QUAD_PASS(Blur6, TgQuadVS, Blur6PS, states)

#endif
// SPDX-License-Identifier: MIT
