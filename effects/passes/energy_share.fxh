// Light that crosses the surface, by the table gEnergyAttenuationMap that the effect declares.
#ifndef TEGUMENT_PASSES_ENERGY_SHARE_FXH
#define TEGUMENT_PASSES_ENERGY_SHARE_FXH

// What the specular layer leaves of light that crosses the surface at this cosine.
float diffuseShare(float cosine)
{
    float albedo = tgHalvesSum(tex2Dlod(gEnergyAttenuation, float4(saturate(cosine), gRoughness, 0.0, 0.0)).xy);
    return tgEnergyDiffuseShare(albedo, gSpecularIntensity);
}

float3 enteringLight(LitPoint p)
{
    return tgIrradianceEntering(p.albedo, gMix, gLightColor, p.cosine, p.shadow, diffuseShare(p.cosine));
}

#endif
