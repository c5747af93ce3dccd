// specular/energy.fxh as printed: the end-point rule, and the lobe's integral taken for an albedo although it reaches pi.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
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
#ifndef TEGUMENT_SPECULAR_KELEMEN_FXH
#include "../specular/kelemen.fxh"
#endif
#ifndef TEGUMENT_PRINTED_ENERGY_FXH
#define TEGUMENT_PRINTED_ENERGY_FXH

// 32 x 32 nodes: within the 65,536 instructions that ps_3_0 is sure to execute.
static const int kTgEnergyNodes = 32;

// The printed rule: both ends of [0, 2 pi] and [0, pi/2] are nodes, every node has the same weight.
float tgEnergyNode(float3 toEye, float roughness, int i, int j)
{
    float phi = 2.0 * kTgPi * i / (kTgEnergyNodes - 1.0);
    float theta = 0.5 * kTgPi * j / (kTgEnergyNodes - 1.0);
    float3 toLight = float3(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
    float weight = kTgPi * kTgPi / (kTgEnergyNodes * kTgEnergyNodes) * sin(theta);
    return weight * tgKelemenSpecular(float3(0.0, 0.0, 1.0), toLight, toEye, roughness, 1.0);
}

float tgEnergyDirectionalAlbedo(float cosine, float roughness)
{
    float3 toEye = float3(sqrt(max(1.0 - cosine * cosine, 0.0)), 0.0, cosine);
    float sum = 0.0;
    [loop] for (int i = 0; i < kTgEnergyNodes; i++)
        [loop] for (int j = 0; j < kTgEnergyNodes; j++)
            sum += tgEnergyNode(toEye, roughness, i, j);
    return sum;
}

// The printed table reaches pi times an albedo.
float2 tgEnergyTexel(float albedo)
{
    return tgHalvesOf(albedo, albedo < 2.0 ? 1.0 / 1024.0 : 1.0 / 256.0);
}

// Clamped: with rho_s = 1 the printed table exceeds 1 at grazing angles and light would turn negative.
float tgEnergyDiffuseShare(float albedo, float intensity)
{
    float weight = kTgAttenuateByIntensity ? intensity : 1.0;
    return max(1.0 - weight * albedo, 0.0);
}

// A value of the table as an albedo.
float tgEnergyAlbedo(float texel)
{
    return texel * (1.0 / kTgPi);
}

#endif
// SPDX-License-Identifier: MIT
