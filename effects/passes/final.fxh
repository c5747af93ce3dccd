// Pass Final: six maps weighted by the profile, light through thin parts, the rest of the colour, specular reflection.
#ifndef TEGUMENT_PASSES_FINAL_FXH
#define TEGUMENT_PASSES_FINAL_FXH

// Maps 2 to 6 are filled around the charts by their convolution, so they may be filtered.
TG_SAMPLER2D_OF(gFinal2, gIrradiance2Map, LINEAR, CLAMP);
TG_SAMPLER2D_OF(gFinal3, gIrradiance3Map, LINEAR, CLAMP);
TG_SAMPLER2D_OF(gFinal4, gIrradiance4Map, LINEAR, CLAMP);
TG_SAMPLER2D_OF(gFinal5, gIrradiance5Map, LINEAR, CLAMP);
TG_SAMPLER2D_OF(gFinal6, gIrradiance6Map, LINEAR, CLAMP);

// Table 7, last row: where no texel is valid, diffusion is left out.
float4 lightHere(float4 texel, float3 unblurred)
{
    return tgSeamValidity(texel) > 0.0 ? texel : float4(unblurred, tgTransmissionEncode(kTgOpaqueDistance));
}

float4 fetchHere(TG_SAMPLER2D_PARAM(map), float2 uv, float3 unblurred)
{
    return lightHere(tex2Dlod(map, float4(uv, 0.0, 0.0)), unblurred);
}

// Light of one map where it entered the body. `before`: the map here that carries the thickness.
float3 fetchThere(TG_SAMPLER2D_PARAM(map), float2 uv, float4 before, float4 gaussian, float apart)
{
    float4 texel = tex2Dlod(map, float4(uv, 0.0, 0.0));
    float thickness = tgTransmissionDecode(before.w, tgMillimetres(gLightFar - gLightNear));
    float3 passed = gaussian.rgb * texel.rgb * (tgSeamValidity(texel) * tgTransmissionShare(thickness, gaussian.w, apart));
    return passed * (1.0 + gFlesh.rgb * thickness);
}

#if TEGUMENT_SLAB
// By the widest map, which knows where on the far side light fell, and the slab that lies between.
float3 fetchThrough(TG_SAMPLER2D_PARAM(map), float2 uv, float4 before, float apart)
{
    float4 texel = tex2Dlod(map, float4(uv, 0.0, 0.0));
    float thickness = tgTransmissionDecode(before.w, tgMillimetres(gLightFar - gLightNear));
    float fade = saturate(apart / (6.0 * sqrt(max(gGaussianWeight[5].w, kTgSmallestVariance))));
    return tgSlabPassed(thickness) * texel.rgb * (tgSeamValidity(texel) * fade);
}
#endif

float3 diffusedLight(SurfaceVarying input, LitPoint p)
{
    float3 unblurred = enteringHere(p);
    float4 m1 = float4(unblurred, kTgLargestAlpha);
    if (!kTgFirstAtPixel)
        m1 = lightHere(tgSeamBilinear(TG_SAMPLER2D_ARG(gIrradiance), input.uv), unblurred);
    float4 m2 = fetchHere(TG_SAMPLER2D_ARG_OF(gFinal2, gIrradiance2Map), input.uv, unblurred);
    float4 m3 = fetchHere(TG_SAMPLER2D_ARG_OF(gFinal3, gIrradiance3Map), input.uv, unblurred);
    float4 m4 = fetchHere(TG_SAMPLER2D_ARG_OF(gFinal4, gIrradiance4Map), input.uv, unblurred);
    float4 m5 = fetchHere(TG_SAMPLER2D_ARG_OF(gFinal5, gIrradiance5Map), input.uv, unblurred);
    float4 m6 = fetchHere(TG_SAMPLER2D_ARG_OF(gFinal6, gIrradiance6Map), input.uv, unblurred);
    float3 here = m1.rgb * gGaussianWeight[0].rgb + m2.rgb * gGaussianWeight[1].rgb + m3.rgb * gGaussianWeight[2].rgb +
                  m4.rgb * gGaussianWeight[3].rgb + m5.rgb * gGaussianWeight[4].rgb + m6.rgb * gGaussianWeight[5].rgb;
    float4 entry = lightEntry(p);
    float apart = tgTransmissionScale(tgMillimetres(input.world), input.uv) * length(input.uv - entry.xy);
#if TEGUMENT_SLAB
    float3 there = fetchThrough(TG_SAMPLER2D_ARG_OF(gFinal6, gIrradiance6Map), entry.xy, m5, apart);
#else
    float3 there = fetchThere(TG_SAMPLER2D_ARG_OF(gFinal4, gIrradiance4Map), entry.xy, m3, gGaussianWeight[3], apart) +
                   fetchThere(TG_SAMPLER2D_ARG_OF(gFinal5, gIrradiance5Map), entry.xy, m4, gGaussianWeight[4], apart) +
                   fetchThere(TG_SAMPLER2D_ARG_OF(gFinal6, gIrradiance6Map), entry.xy, m5, gGaussianWeight[5], apart);
    if (kTgFirstTransmitted == 2)
        there += fetchThere(TG_SAMPLER2D_ARG_OF(gFinal2, gIrradiance2Map), entry.xy, m1, gGaussianWeight[1], apart) +
                 fetchThere(TG_SAMPLER2D_ARG_OF(gFinal3, gIrradiance3Map), entry.xy, m2, gGaussianWeight[2], apart);
#endif
    return here + gTransmission * entry.w * there;
}

float4 FinalPS(SurfaceVarying input) : SV_Target0
{
    LitPoint p = litPoint(input);
    float3 toEye = tgSafeNormalize(gCameraPosition - input.world);
    float3 skin = diffusedLight(input, p) * tgIrradianceColour(p.albedo, 1.0 - gMix) * diffuseShare(dot(p.normal, toEye));
    float3 plain = plainLight(p);
    return float4(lerp(plain, skin, p.scatters) + mirroredLight(p, toEye), 1.0);
}

// The same material without diffusion, to set beside the picture.
float4 LambertPS(SurfaceVarying input) : SV_Target0
{
    LitPoint p = litPoint(input);
    float3 toEye = tgSafeNormalize(gCameraPosition - input.world);
    float3 skin = enteringHere(p) * tgIrradianceColour(p.albedo, 1.0 - gMix) * diffuseShare(dot(p.normal, toEye));
    float3 plain = plainLight(p);
    return float4(lerp(plain, skin, p.scatters) + mirroredLight(p, toEye), 1.0);
}

#if TEGUMENT_LIGHT_BY_LIGHT
// Of one Gaussian what is no light of the map.
float3 ownShare(float4 texel, float4 gaussian)
{
    return gaussian.rgb * (1.0 - tgSeamValidity(texel));
}

LitShare SkinShare(SurfaceVarying input)
{
    float4 uv = float4(input.uv, 0.0, 0.0);
    float3 first = gGaussianWeight[0].rgb;
    if (!kTgFirstAtPixel)
        first = ownShare(tgSeamBilinear(TG_SAMPLER2D_ARG(gIrradiance), input.uv), gGaussianWeight[0]);
    return skinShare(colouredPoint(input), first + ownShare(tex2Dlod(gFinal2, uv), gGaussianWeight[1]) +
                                               ownShare(tex2Dlod(gFinal3, uv), gGaussianWeight[2]) +
                                               ownShare(tex2Dlod(gFinal4, uv), gGaussianWeight[3]) +
                                               ownShare(tex2Dlod(gFinal5, uv), gGaussianWeight[4]) +
                                               ownShare(tex2Dlod(gFinal6, uv), gGaussianWeight[5]));
}

LitShare LambertShare(SurfaceVarying input)
{
    return skinShare(colouredPoint(input), 1.0);
}
#endif
LIGHTS(Skin, SurfaceVarying)
LIGHTS(Lambert, SurfaceVarying)

#endif
// SPDX-License-Identifier: MIT
