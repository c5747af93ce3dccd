// Texels outside the charts carry alpha = 1 (the maps are cleared to (0,0,0,1)); covered texels at most 0.99. A map that is not filled
// around its charts is therefore read by POINT taps only: a filtered alpha of 0.95 would pass for valid although much of the colour is
// black.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SCATTER_SEAM_FXH
#define TEGUMENT_SCATTER_SEAM_FXH

static const float4 kTgInvalidTexel = float4(0.0, 0.0, 0.0, 1.0);

// 1 inside a chart. Half-way between the largest valid alpha and 1, so that a half's rounding does not matter.
float tgSeamValidity(float4 texel)
{
    return !kTgRepairSeams || texel.w < 0.5 * (kTgLargestAlpha + 1.0) ? 1.0 : 0.0;
}

// Bilinear look-up over the valid texels among four; kTgInvalidTexel where there is none.
float4 tgSeamBilinear(TG_SAMPLER2D_PARAM(map), float2 uv)
{
    float2 position = uv * kTgMapSize - 0.5;
    float2 f = frac(position);
    float2 corner = (position - f + 0.5) / kTgMapSize;
    float4 sum = 0.0;
    float total = 0.0;
    [unroll] for (int j = 0; j < 2; j++)
        [unroll] for (int i = 0; i < 2; i++)
        {
            float4 texel = TG_TEX2DLOD(map, float4(corner + float2(i, j) / kTgMapSize, 0.0, 0.0));
            float weight = abs(1.0 - i - f.x) * abs(1.0 - j - f.y) * tgSeamValidity(texel);
            sum += weight * texel;
            total += weight;
        }
    return total > 1e-4 ? sum / max(total, 1e-4) : kTgInvalidTexel;
}

#endif
// SPDX-License-Identifier: MIT
