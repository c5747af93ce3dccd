// How much of the map one millimetre of the surface covers (d'Eon and Luebke 2007, "Accounting for Stretching"; seed equations 25 to 27).
// Units: uv per mm along U and V; encoded as docs/design/modules/Stretch.md says. Alpha of a Stretch map is 1 outside the charts, 0 inside.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SURFACE_STRETCH_FXH
#define TEGUMENT_SURFACE_STRETCH_FXH

// A texel smaller than this (mm) belongs to a degenerate triangle: its stretch would be infinite.
static const float kTgSmallestTexel = 1e-3;

// texelU, texelV: world-space step across one texel of a map with `size` texels a side. Exact: an unwrapped triangle is affine.
float2 tgStretchEncode(float3 texelU, float3 texelV, float size)
{
    float2 millimetres = max(float2(length(texelU), length(texelV)), kTgSmallestTexel);
    return kTgStretchScale / (millimetres * size);
}

float2 tgStretchUvPerMillimetre(float4 texel)
{
    return texel.xy / kTgStretchScale;
}

#endif
// SPDX-License-Identifier: MIT
