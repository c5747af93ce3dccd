// Pass Final of Gosselin's technique: the blurred light times colour, and specular reflection.
#ifndef TEGUMENT_PASSES_FINAL_GOSSELIN_FXH
#define TEGUMENT_PASSES_FINAL_GOSSELIN_FXH

// Table 7, last row: where no texel is valid, N.L. Plain material does not scatter; without the shadow map its light has to come from the
// blur, which a kernel size of 0 leaves as it is.
float gosselinScattered(float4 texel, float scatters)
{
    return tgSeamValidity(texel) * (kTgShadowSpecular ? scatters : 1.0);
}

float3 gosselinDiffuse(TG_SAMPLER2D_PARAM(map), float2 uv, LitPoint p)
{
    float4 texel = tgSeamBilinear(TG_SAMPLER2D_ARG(map), uv);
    return lerp(diffuseHere(p), texel.rgb, gosselinScattered(texel, p.scatters));
}

float4 gosselinFinal(TG_SAMPLER2D_PARAM(map), SurfaceVarying input)
{
    LitPoint p = surfacePoint(input);
    float4 colour = tex2D(gSkin, input.uv);
    p.scatters = colour.a;
    if (kTgShadowSpecular)
        p.shadow = surfaceShadow(TG_SAMPLER2D_ARG(gShadow), p);
    float3 toEye = tgSafeNormalize(gCameraPosition - input.world);
    return float4(colour.rgb * gosselinDiffuse(TG_SAMPLER2D_ARG(map), input.uv, p) + mirroredLight(p, toEye), 1.0);
}

float4 GosselinFinalPS(SurfaceVarying input) : SV_Target0
{
    return gosselinFinal(TG_SAMPLER2D_ARG(gBlurOdd), input);
}

float4 GosselinFinalEvenPS(SurfaceVarying input) : SV_Target0
{
    return gosselinFinal(TG_SAMPLER2D_ARG(gBlurEven), input);
}

#if TEGUMENT_LIGHT_BY_LIGHT
LitShare gosselinShare(TG_SAMPLER2D_PARAM(map), SurfaceVarying input)
{
    LitShare s;
    s.p = surfacePoint(input);
    float4 colour = tex2D(gSkin, input.uv);
    s.p.scatters = colour.a;
    s.plain = colour.rgb * (1.0 - gosselinScattered(tgSeamBilinear(TG_SAMPLER2D_ARG(map), input.uv), colour.a));
    s.skin = 0.0;
    return s;
}

LitShare GosselinShare(SurfaceVarying input)
{
    return gosselinShare(TG_SAMPLER2D_ARG(gBlurOdd), input);
}

LitShare GosselinEvenShare(SurfaceVarying input)
{
    return gosselinShare(TG_SAMPLER2D_ARG(gBlurEven), input);
}
#endif
LIGHTS(Gosselin, SurfaceVarying)
LIGHTS(GosselinEven, SurfaceVarying)

#endif
// SPDX-License-Identifier: MIT
