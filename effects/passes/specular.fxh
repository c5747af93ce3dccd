// Specular reflection of skin, and of plain material (eyeballs).
#ifndef TEGUMENT_PASSES_SPECULAR_FXH
#define TEGUMENT_PASSES_SPECULAR_FXH

float gRoughness < string UIName = "Roughness"; string UIWidget = "Slider"; float UIMin = 0.05; float UIMax = 1.0; float UIStep = 0.01;
    string UIHelp = "Beckmann m, rms slope"; > = 0.3;
float gSpecularIntensity < string UIName = "Specular intensity"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 1.0;
    float UIStep = 0.01; string UIHelp = "rho_s"; > = 0.18;
float gPlainRoughness < string UIName = "Roughness of plain material"; string UIWidget = "Slider"; float UIMin = 0.05; float UIMax = 1.0;
    float UIStep = 0.01; string UIHelp = "Beckmann m"; > = 0.1;
float gPlainIntensity < string UIName = "Specular intensity of plain material"; string UIWidget = "Slider"; float UIMin = 0.0;
    float UIMax = 1.0; float UIStep = 0.01; string UIHelp = "rho_s"; > = 0.5;

float3 reflectedLight(LitPoint p, float3 toEye)
{
    float roughness = lerp(gPlainRoughness, gRoughness, p.scatters);
    float intensity = lerp(gPlainIntensity, gSpecularIntensity, p.scatters);
    return gLightColor * p.shadow * tgKelemenSpecular(p.normal, p.toLight, toEye, roughness, intensity);
}

#endif
