// Passes Irradiance and Final of Gosselin's technique: diffuse light without colour into texture space, alpha = kernel size; the blurred light times
// colour, and specular reflection.
#ifndef TEGUMENT_PASSES_GOSSELIN_FXH
#define TEGUMENT_PASSES_GOSSELIN_FXH

Texture2D gKernelSizeMap : KERNELSIZE < float4 Fallback = { 0.6, 0.6, 0.6, 1.0 }; string UIName = "Kernel size map"; >;
SAMPLER2D(gKernelSize, LINEAR, CLAMP);

float3 diffuseLight(LitPoint p)
{
    return gLightColor * (saturate(p.cosine) * p.shadow);
}

float4 GosselinIrradiancePS(SurfaceVarying input) : SV_Target0
{
    LitPoint p = surfacePoint(input);
    p.shadow = surfaceShadow(SAMPLER2D_ARG(gShadow), p);
    return float4(diffuseLight(p), min(tex2D(gKernelSize, input.uv).x, kLargestAlpha));
}

// Table 7, last row: where no texel is valid, N.L. Plain material does not scatter; without the shadow map its light has to come from the blur, which
// a kernel size of 0 leaves as it is.
float3 gosselinDiffuse(SAMPLER2D_PARAM(map), float2 uv, LitPoint p)
{
    float4 texel = seamBilinear(SAMPLER2D_ARG(map), uv);
    float scattered = seamValidity(texel) * (kShadowSpecular ? p.scatters : 1.0);
    return lerp(diffuseLight(p), texel.rgb, scattered);
}

float4 gosselinFinal(SAMPLER2D_PARAM(map), SurfaceVarying input)
{
    LitPoint p = surfacePoint(input);
    float4 colour = tex2D(gSkin, input.uv);
    p.scatters = colour.a;
    if (kShadowSpecular)
        p.shadow = surfaceShadow(SAMPLER2D_ARG(gShadow), p);
    float3 toEye = safeNormalize(gCameraPosition - input.world);
    return float4(colour.rgb * gosselinDiffuse(SAMPLER2D_ARG(map), input.uv, p) + reflectedLight(p, toEye), 1.0);
}

float4 GosselinFinalPS(SurfaceVarying input) : SV_Target0
{
    return gosselinFinal(SAMPLER2D_ARG(gBlurOdd), input);
}

float4 GosselinFinalEvenPS(SurfaceVarying input) : SV_Target0
{
    return gosselinFinal(SAMPLER2D_ARG(gBlurEven), input);
}

#endif
