// scatter/poisson.fxh as printed (seed 5.3, equations 36 and 40, Table 7): the disc off its own centre, radii in texels of the map,
// whatever its stretch.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SCATTER_SEAM_FXH
#include "../scatter/seam.fxh"
#endif
#ifndef TEGUMENT_SCATTER_DISC_FXH
#include "../scatter/disc.fxh"
#endif
#ifndef TEGUMENT_PRINTED_POISSON_FXH
#define TEGUMENT_PRINTED_POISSON_FXH

float2 tgPoissonPoint(int i, float2 rotation)
{
    float2 p = kTgPoissonDisc[i];
    return float2(p.x * rotation.x - p.y * rotation.y, p.x * rotation.y + p.y * rotation.x);
}

// Equation 40, size * kernel * (1 / width + 1 / height), where size is half the radius in texels.
float2 tgPoissonRadius(float size, float4 centre, float2 density)
{
    float kernel = min(centre.w, kTgLargestAlpha);
    float2 texels = size * kernel * float2(2.0, 2.0);
    return texels / kTgMapSize;
}

// Table 7: an invalid centre becomes the first valid neighbour in the order of the disc; then invalid taps take the centre's value
// (equation 36).
float4 tgPoissonBlur(TG_SAMPLER2D_PARAM(map), float2 uv, float4 centre, float2 radius, float2 rotation)
{
    float4 tap[12];
    [unroll] for (int i = 0; i < 12; i++)
        tap[i] = TG_TEX2DLOD(map, float4(uv + tgPoissonPoint(i, rotation) * radius, 0.0, 0.0));
    float4 first = centre;
    [unroll] for (int k = 11; k >= 0; k--)
        first = tgSeamValidity(tap[k]) > 0.0 ? tap[k] : first;
    first = tgSeamValidity(centre) > 0.0 ? centre : first;
    float3 sum = first.rgb;
    [unroll] for (int j = 0; j < 12; j++)
        sum += tgSeamValidity(tap[j]) > 0.0 ? tap[j].rgb : first.rgb;
    return float4(sum / 13.0, first.w);
}

#endif
// SPDX-License-Identifier: MIT
