// Specular reflection of Kelemen and Szirmay-Kalos (2001), the choice of d'Eon and Luebke (2007).
//   specular = N.L rho_s PH(N.H, m) F(V.H) / |L + V|^2 , no 1/pi, like the diffuse term (docs/conventions.md)
// Unit vectors from the surface: toLight, toEye. intensity = rho_s.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_CONSTANTS_FXH
#include "../constants.fxh"
#endif
#ifndef TEGUMENT_PRINTED_SEED_FXH
#include "../printed/seed.fxh"
#endif
#ifndef TEGUMENT_PRINTED_DEON2007_FXH
#include "../printed/deon2007.fxh"
#endif
#ifndef TEGUMENT_SURFACE_NORMAL_FXH
#include "../surface/normal.fxh"
#endif
#ifndef TEGUMENT_SPECULAR_FRESNEL_FXH
#include "../specular/fresnel.fxh"
#endif
#ifndef TEGUMENT_SPECULAR_BECKMANN_FXH
#include "../specular/beckmann.fxh"
#endif
#ifndef TEGUMENT_SPECULAR_KELEMEN_FXH
#define TEGUMENT_SPECULAR_KELEMEN_FXH

// |L + V|^2 is 4 (L.H)^2: it vanishes when the light stands behind the point, where N.L of a visible point is 0 or small too.
static const float kTgSmallestHalfSquare = 1e-4;

float tgKelemenSpecular(float3 normal, float3 toLight, float3 toEye, float roughness, float intensity)
{
    float3 h = toLight + toEye;
    float3 halfway = tgSafeNormalize(h);
    float ph = tgBeckmannPH(dot(normal, halfway), roughness);
    float fresnel = tgFresnelSchlick(dot(toEye, halfway), kTgFresnel0);
    return saturate(dot(normal, toLight)) * intensity * ph * fresnel / max(dot(h, h), kTgSmallestHalfSquare);
}

#endif
// SPDX-License-Identifier: MIT
