// Sums over what more_light.fxh declares, at a LitPoint.
#ifndef TEGUMENT_PASSES_MORE_LIGHT_SUM_FXH
#define TEGUMENT_PASSES_MORE_LIGHT_SUM_FXH

#if TEGUMENT_SURROUNDINGS
// Irradiance / pi on the surface.
float3 moreIrradiance(LitPoint p)
{
    return surroundingsLight(p.uv, p.normal, p.meshNormal).rgb;
}

// Of it what enters skin.
float3 moreEntering(LitPoint p)
{
    return moreIrradiance(p) * tgIrradianceColour(p.albedo, gMix) * diffuseShare(kTgMeanCosine);
}

// Mirrored towards the eye. The lobe's albedo is what diffuseShare() leaves out.
float3 moreReflected(LitPoint p, float3 toEye)
{
    float cosine = dot(p.normal, toEye);
    float roughness = lerp(gPlainRoughness, gRoughness, p.scatters);
    float intensity = lerp(gPlainIntensity, gSpecularIntensity, p.scatters);
    float albedo = intensity * tgEnergyAlbedo(tgHalvesSum(energyTexel(cosine, roughness)));
    float open = surroundingsLight(p.uv, p.normal, p.meshNormal).w;
    float share = albedo * tgSurroundingsReflectedShare(cosine, open, roughness);
    return gReflections * share * surroundingsAt(reflect(-toEye, p.normal), tgSurroundingsLevel(roughness));
}
#endif

#endif
