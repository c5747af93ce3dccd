// Light that the specular layer takes from the diffuse one: directional albedo of the Kelemen/Szirmay-Kalos lobe with rho_s = 1.
//   rho_dt(cos, m) = integral over the hemisphere of PH F / |L + V|^2 N.w dw   (d'Eon and Luebke 2007, "Specular and energy conservation")
// over pi, by importance sampling. Stored in a texture, x = cosine, y = roughness, as two halves (surface/halves.fxh).
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
#ifndef TEGUMENT_SURFACE_HALVES_FXH
#include "../surface/halves.fxh"
#endif
#ifndef TEGUMENT_SPECULAR_FRESNEL_FXH
#include "../specular/fresnel.fxh"
#endif
#ifndef TEGUMENT_SPECULAR_ENERGY_FXH
#define TEGUMENT_SPECULAR_ENERGY_FXH

// 32 x 32 nodes: within the 65,536 instructions that ps_3_0 is sure to execute.
static const int kTgEnergyNodes = 32;

// Half vectors drawn from PH N.H / pi, so tan^2 = -m^2 ln(1 - u). With dw = 4 V.H dH and |L + V| = 2 V.H the integrand over the density
// becomes pi F N.L / (V.H N.H) = pi F (2 - N.V / (V.H N.H)), which is bounded and continuous. Midpoints; half a turn, by symmetry.
float tgEnergyNode(float3 toEye, float roughness, int i, int j)
{
    float phi = kTgPi * (i + 0.5) / kTgEnergyNodes;
    float u = (j + 0.5) / kTgEnergyNodes;
    float slope = roughness * sqrt(-log(1.0 - u));
    float cosine = rsqrt(1.0 + slope * slope);
    float sine = slope * cosine;
    float3 halfway = float3(sine * cos(phi), sine * sin(phi), cosine);
    float vh = dot(toEye, halfway);
    float share = vh > 0.0 ? max(2.0 - toEye.z / (vh * cosine), 0.0) : 0.0;
    return tgFresnelSchlick(vh, kTgFresnel0) * share * kTgPi / (kTgEnergyNodes * kTgEnergyNodes);
}

// The lobe integrates to pi, not 1 (docs/conventions.md): an albedo is a pi-th of it.
float tgEnergyDirectionalAlbedo(float cosine, float roughness)
{
    float3 toEye = float3(sqrt(max(1.0 - cosine * cosine, 0.0)), 0.0, cosine);
    float sum = 0.0;
    [loop] for (int i = 0; i < kTgEnergyNodes; i++)
        [loop] for (int j = 0; j < kTgEnergyNodes; j++)
            sum += tgEnergyNode(toEye, roughness, i, j);
    return sum * (1.0 / kTgPi);
}

float2 tgEnergyTexel(float albedo)
{
    return tgHalvesOf(albedo, 1.0 / 1024.0);
}

// Share of light left to diffusion.
float tgEnergyDiffuseShare(float albedo, float intensity)
{
    return max(1.0 - intensity * albedo, 0.0);
}

// A value of the table as an albedo.
float tgEnergyAlbedo(float texel)
{
    return texel;
}

#endif
// SPDX-License-Identifier: MIT
