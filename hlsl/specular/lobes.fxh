// Two lobes of one surface, and lobes as wide as the relief that a normal map no longer shows.
#ifndef TEGUMENT_SPECULAR_KELEMEN_FXH
#include "../specular/kelemen.fxh"
#endif
#ifndef TEGUMENT_SPECULAR_LOBES_FXH
#define TEGUMENT_SPECULAR_LOBES_FXH

// A variance below this may be the map's own rounding: each of three channels is off by half of 1 / 255.
static const float kTgNormalRounding = 0.004;
// The shortest mean of unit normals that is believed, and the widest lobe.
static const float kTgShortestNormal = 0.5;
static const float kTgWidestRoughness = 1.0;

// Variance of slopes along each axis whose unit normals have a mean of this length. Gaussian slopes of variance v have the mean length
// int_0^inf exp(-t) / sqrt(1 + 2 v t) dt; (|n|^-4 - 1) / 4 is its inverse within 2.5 % up to v = 0.5. 1 / |n| - 1 (Toksvig 2005,
// "Mipmapping Normal Maps") is 7 % short at 0.04, 25 % at 0.25.
float tgLostVariance(float meanLength)
{
    float squared = max(meanLength, kTgShortestNormal) * max(meanLength, kTgShortestNormal);
    float variance = (1.0 / (squared * squared) - 1.0) / 4.0;
    return sqrt(max(variance - kTgNormalRounding, 0.0) * (variance + kTgNormalRounding));
}

// Beckmann m of a surface whose normals have this mean length, from a look-up between mip levels. A lobe's slopes have the variance
// m^2 / 2, and variances add up.
float tgRoughnessWidened(float roughness, float meanLength)
{
    return min(sqrt(roughness * roughness + 2.0 * tgLostVariance(meanLength)), max(roughness, kTgWidestRoughness));
}

// share: of the second lobe. Both have the same Fresnel term, so rho_s stays what it is.
float tgTwoLobes(float3 normal, float3 toLight, float3 toEye, float2 roughness, float share, float intensity)
{
    return lerp(tgKelemenSpecular(normal, toLight, toEye, roughness.x, intensity),
                tgKelemenSpecular(normal, toLight, toEye, roughness.y, intensity), share);
}

#endif
// SPDX-License-Identifier: MIT
