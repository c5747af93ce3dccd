// Two lobes of one surface, and lobes as wide as the relief that a normal map no longer shows.
#ifndef TEGUMENT_SPECULAR_KELEMEN_FXH
#include "../specular/kelemen.fxh"
#endif
#ifndef TEGUMENT_SPECULAR_LOBES_FXH
#define TEGUMENT_SPECULAR_LOBES_FXH

// Of 1 / |n| - 1, what is the map's own rounding: each of three channels is off by half of 1 / 255.
static const float kTgNormalRounding = 0.004;
// The shortest mean of unit normals that is believed, and the widest lobe.
static const float kTgShortestNormal = 0.5;
static const float kTgWidestRoughness = 1.0;

// Beckmann m of a surface whose normals have this mean length, from a look-up between mip levels. Slopes have the variance 1 / |n| - 1
// along each axis (Toksvig 2005, "Mipmapping Normal Maps"); a lobe's is m^2 / 2, and variances add up.
float tgRoughnessWidened(float roughness, float meanLength)
{
    float lost = max(1.0 / max(meanLength, kTgShortestNormal) - 1.0 - kTgNormalRounding, 0.0);
    return min(sqrt(roughness * roughness + 2.0 * lost), max(roughness, kTgWidestRoughness));
}

// share: of the second lobe. Both have the same Fresnel term, so rho_s stays what it is.
float tgTwoLobes(float3 normal, float3 toLight, float3 toEye, float2 roughness, float share, float intensity)
{
    return lerp(tgKelemenSpecular(normal, toLight, toEye, roughness.x, intensity),
                tgKelemenSpecular(normal, toLight, toEye, roughness.y, intensity), share);
}

#endif
