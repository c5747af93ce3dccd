// Specular reflection of skin, and of plain material (eyeballs).
#ifndef TEGUMENT_PASSES_SPECULAR_FXH
#define TEGUMENT_PASSES_SPECULAR_FXH

float gRoughness < UI_SLIDER("Roughness", 0.05, 1.0, 0.01) string UIHelp = "Beckmann m, rms slope"; > = 0.3;
float gSpecularIntensity < UI_SLIDER("Specular intensity", 0.0, 1.0, 0.01) string UIHelp = "rho_s"; > = TG_SKIN_SPECULAR_INTENSITY;
float gPlainRoughness < UI_SLIDER("Roughness of plain material", 0.05, 1.0, 0.01) string UIHelp = "Beckmann m"; > = 0.1;
float gPlainIntensity < UI_SLIDER("Specular intensity of plain material", 0.0, 1.0, 0.01) string UIHelp = "rho_s"; > = 0.5;

#if TEGUMENT_LOBES
float gSecondRoughness < UI_SLIDER("Roughness of the second lobe", 0.05, 1.0, 0.01) string UIHelp = "Beckmann m"; > = 0.15;
float gSecondLobe < UI_SLIDER("Second lobe", 0.0, 1.0, 0.01) string UIHelp = "its share of rho_s"; > = 0.15;
float gLostRelief < UI_SLIDER("Relief that is lost", 0.0, 1.0, 0.01)
    string UIHelp = "how much of what the normal map loses with distance widens the lobes"; > = 1.0;

float3 specularLobes(LitPoint p)
{
    float2 skin = float2(gRoughness, gSecondRoughness) * p.shine.x;
    float2 roughness = lerp(float2(gPlainRoughness, gPlainRoughness), skin, p.scatters);
    float mean = lerp(1.0, p.meanNormal, gLostRelief);
    return float3(tgRoughnessWidened(roughness.x, mean), tgRoughnessWidened(roughness.y, mean), gSecondLobe);
}

// With this weight of the specular layer.
float surfaceSpecular(LitPoint p, float3 toLight, float3 toEye, float intensity)
{
    float3 lobes = specularLobes(p);
    return tgTwoLobes(p.normal, toLight, toEye, lobes.xy, lobes.z, intensity);
}
#else
float surfaceSpecular(LitPoint p, float3 toLight, float3 toEye, float intensity)
{
    float roughness = lerp(gPlainRoughness, gRoughness, p.scatters);
    return tgKelemenSpecular(p.normal, toLight, toEye, roughness, intensity);
}
#endif

float3 reflectedLight(LitPoint p, float3 toEye)
{
    float intensity = lerp(gPlainIntensity, TG_SKIN_INTENSITY(p), p.scatters);
    return p.light * p.shadow * surfaceSpecular(p, p.toLight, toEye, intensity);
}

#endif
// SPDX-License-Identifier: MIT
