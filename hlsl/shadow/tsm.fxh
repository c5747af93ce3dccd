// Translucent shadow map, modified: depth and texture coordinates of the surface nearest to the light (d'Eon and Luebke 2007, "Modified
// translucent shadow maps"; after Dachsbacher and Stamminger 2003). Texel = (depth, u, v, 1); zeros where there is no surface. Depth as in
// shadow/filter.fxh.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SURFACE_NORMAL_FXH
#include "../surface/normal.fxh"
#endif
#ifndef TEGUMENT_SHADOW_MAP_FXH
#include "../shadow/map.fxh"
#endif
#ifndef TEGUMENT_SHADOW_FILTER_FXH
#include "../shadow/filter.fxh"
#endif
#ifndef TEGUMENT_PRINTED_FILTER_FXH
#include "../printed/filter.fxh"
#endif
#ifndef TEGUMENT_SHADOW_TSM_FXH
#define TEGUMENT_SHADOW_TSM_FXH

// Texels whose texture coordinates differ by less are one piece of surface: 3 % of the map, about 9 mm of a head.
static const float kTgOnePiece = 0.03;

// Normal of the lit surface, from the slope of its depths. axisX, axisY: the light's right and up; footprint: mm of a texel; range: mm of a
// unit depth.
float3 tgTsmNormal(TG_SAMPLER2D_PARAM(tsm), float2 coordinate, float3 axisX, float3 axisY, float3 toLight, float footprint, float range)
{
    float2 texel = float2(1.0, 0.0) / kTgShadowSize;
    float4 around;
    around.x = TG_TEX2DLOD(tsm, float4(coordinate + texel.xy, 0.0, 0.0)).x;
    around.y = TG_TEX2DLOD(tsm, float4(coordinate - texel.xy, 0.0, 0.0)).x;
    around.z = TG_TEX2DLOD(tsm, float4(coordinate - texel.yx, 0.0, 0.0)).x;
    around.w = TG_TEX2DLOD(tsm, float4(coordinate + texel.yx, 0.0, 0.0)).x;
    float4 depth = tgShadowStored(around);
    float3 back = cross(axisX, axisY);
    float3 acrossX = tgTsmAcross(axisX, back, toLight);
    float3 acrossY = tgTsmAcross(axisY, back, toLight);
    return tgSafeNormalize(2.0 * footprint * toLight + range * ((depth.x - depth.y) * acrossX + (depth.z - depth.w) * acrossY));
}

// Point where the light entered: interpolated where the four texels lie on one piece of the surface, else the nearest texel. Seen at a
// grazing angle neighbouring texels lie far apart on the surface; read singly they would print their steps on the side away from the light.
// None outside of the map.
float4 tgTsmEntry(TG_SAMPLER2D_PARAM(tsm), float2 coordinate)
{
    float2 position = coordinate * kTgShadowSize - 0.5;
    float2 f = frac(position);
    float2 corner = (position - f + 0.5) / kTgShadowSize;
    float4 a = TG_TEX2DLOD(tsm, float4(corner, 0.0, 0.0));
    float4 b = TG_TEX2DLOD(tsm, float4(corner + float2(1.0, 0.0) / kTgShadowSize, 0.0, 0.0));
    float4 c = TG_TEX2DLOD(tsm, float4(corner + float2(0.0, 1.0) / kTgShadowSize, 0.0, 0.0));
    float4 d = TG_TEX2DLOD(tsm, float4(corner + float2(1.0, 1.0) / kTgShadowSize, 0.0, 0.0));
    float3 spread = max(max(a, b), max(c, d)).yzw - min(min(a, b), min(c, d)).yzw;
    float4 nearest = lerp(lerp(a, b, step(0.5, f.x)), lerp(c, d, step(0.5, f.x)), step(0.5, f.y));
    float4 entry = max(spread.x, max(spread.y, spread.z)) < kTgOnePiece ? lerp(lerp(a, b, f.x), lerp(c, d, f.x), f.y) : nearest;
    return tgShadowBeyond(coordinate) > 0.0 ? float4(0.0, 0.0, 0.0, 0.0) : entry;
}

#endif
// SPDX-License-Identifier: MIT
