// What the specular layer leaves of light that crosses the surface, by the table gEnergyAttenuationMap that the effect declares.
#ifndef TEGUMENT_PASSES_DIFFUSE_SHARE_FXH
#define TEGUMENT_PASSES_DIFFUSE_SHARE_FXH

float2 energyTexel(float cosine, float roughness)
{
    return tex2Dlod(gEnergyAttenuation, float4(saturate(cosine), roughness, 0.0, 0.0)).xy;
}

// At this cosine.
float diffuseShare(float cosine)
{
    float albedo = tgHalvesSum(energyTexel(cosine, gRoughness));
#if TEGUMENT_LOBES
    albedo = lerp(albedo, tgHalvesSum(energyTexel(cosine, gSecondRoughness)), gSecondLobe);
#endif
    return tgEnergyDiffuseShare(albedo, gSpecularIntensity);
}

#endif
// SPDX-License-Identifier: MIT
