// One blur of Gosselin's technique (Gosselin, Sander and Mitchell 2004): 13 taps, the texel itself and twelve of a Poisson disc (seed 5.3,
// equations 36 and 40). The alpha of the map is the kernel size, at most kTgLargestAlpha; every blur leaves it as it is.
// Units: size in mm on the surface, density = texels per mm; radii in uv, one along each axis.
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
#ifndef TEGUMENT_SCATTER_POISSON_FXH
#define TEGUMENT_SCATTER_POISSON_FXH

// Mean of the printed points. Left in, each blur shifts the light by a tenth of the radius.
static const float2 kTgPoissonMean = float2(0.030452, -0.104674);
// Outside the charts the taps reach this far at least (texels), so that what Final looks up between texels is filled.
static const float kTgPoissonFill = 3.0;

// rotation: cosine and sine of the angle by which the disc is turned.
float2 tgPoissonPoint(int i, float2 rotation)
{
    float2 p = kTgPoissonDisc[i] - kTgPoissonMean;
    return float2(p.x * rotation.x - p.y * rotation.y, p.x * rotation.y + p.y * rotation.x);
}

float2 tgPoissonRadius(float size, float4 centre, float2 density)
{
    float kernel = min(centre.w, kTgLargestAlpha);
    float2 texels = size * kernel * density;
    return (tgSeamValidity(centre) < 1.0 ? max(texels, kTgPoissonFill) : texels) / kTgMapSize;
}

// The mean of the valid taps. A texel outside the charts takes their mean kernel size too.
float4 tgPoissonBlur(TG_SAMPLER2D_PARAM(map), float2 uv, float4 centre, float2 radius, float2 rotation)
{
    float inside = tgSeamValidity(centre);
    float4 sum = inside * centre;
    float total = inside;
    [unroll] for (int i = 0; i < 12; i++)
    {
        float4 tap = TG_TEX2DLOD(map, float4(uv + tgPoissonPoint(i, rotation) * radius, 0.0, 0.0));
        float validity = tgSeamValidity(tap);
        sum += validity * tap;
        total += validity;
    }
    float4 mean = sum / max(total, 1.0);
    return total > 0.0 ? float4(mean.rgb, inside > 0.0 ? centre.w : mean.w) : kTgInvalidTexel;
}

#endif
// SPDX-License-Identifier: MIT
