// Specular reflection of skin, and of plain material (eyeballs).
#ifndef TEGUMENT_PASSES_SPECULAR_FXH
#define TEGUMENT_PASSES_SPECULAR_FXH

float gRoughness < UI_SLIDER("Roughness", 0.05, 1.0, 0.01) string UIHelp = "Beckmann m, rms slope"; > = 0.3;
float gSpecularIntensity < UI_SLIDER("Specular intensity", 0.0, 1.0, 0.01) string UIHelp = "rho_s"; > = 0.18;
float gPlainRoughness < UI_SLIDER("Roughness of plain material", 0.05, 1.0, 0.01) string UIHelp = "Beckmann m"; > = 0.1;
float gPlainIntensity < UI_SLIDER("Specular intensity of plain material", 0.0, 1.0, 0.01) string UIHelp = "rho_s"; > = 0.5;

float3 reflectedLight(LitPoint p, float3 toEye)
{
    float roughness = lerp(gPlainRoughness, gRoughness, p.scatters);
    float intensity = lerp(gPlainIntensity, gSpecularIntensity, p.scatters);
    return gLightColor * p.shadow * tgKelemenSpecular(p.normal, p.toLight, toEye, roughness, intensity);
}

#endif
