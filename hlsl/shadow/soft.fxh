// Shadows with a penumbra: as wide as a light of some size makes it, by the distance between what throws the shadow and what receives it
// (Fernando 2005, "Percentage-Closer Soft Shadows"). A texel of the map counts as hiding the light only where its distance suffices to hide
// some of it. Distances as in planar.fxh.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SHADOW_MAP_FXH
#include "../shadow/map.fxh"
#endif
#ifndef TEGUMENT_SHADOW_SOFT_FXH
#define TEGUMENT_SHADOW_SOFT_FXH

static const int kTgSoftSearch = 64;
static const int kTgSoftTaps = 32;
// pi (3 - sqrt 5): neighbours in a spiral never line up.
static const float kTgSoftTurn = 2.3999632;
// The least radius of the filter, texels of the map: that of four taps 0.75 texels apart.
static const float kTgSoftNarrowest = 1.5;

// In 0..1, from pixel to pixel (Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare"). pixel: whole numbers.
float tgSoftNoise(float2 pixel)
{
    return frac(52.9829189 * frac(dot(floor(pixel), float2(0.06711056, 0.00583715))));
}

// Place number i of so many in a disc of radius 1, each for an equal area (Vogel 1979). turn: rad.
float2 tgSoftTap(int i, int count, float turn)
{
    float angle = i * kTgSoftTurn + turn;
    return sqrt((i + 0.5) / count) * float2(cos(angle), sin(angle));
}

// The receiver's plane at a place in the map, and what the map holds there, mm. offset: texels. From a point the plane's distance is the
// reciprocal of what is linear in the map.
float2 tgSoftDepths(TG_SAMPLER2D_PARAM(map), float2 coordinate, float2 offset, float depth, float2 slope, float2 size)
{
    float2 place = coordinate + offset / kTgShadowSize;
    float stored = tgShadowStored(TG_TEX2DLOD(map, float4(place, 0.0, 0.0))).x;
    float rise = dot(slope, offset);
    float plane = depth + rise / max(1.0 - size.y * rise / max(depth, 1e-3), 0.05);
    return float2(plane, tgShadowBeyond(place) > 0.0 ? kTgNoSurface : stored);
}

// How far a place that hides some of the light may lie from the one that it is hidden from, mm in the map at the receiver's distance. gap:
// mm between the two along the axis; before: mm from the light to what hides it. size: of a light at a point its radius, mm, and 1; of
// parallel light the tangent of its half angle, and 0.
float tgSoftWidth(float2 size, float gap, float before)
{
    return size.x * gap / max(lerp(1.0, before, size.y), 1e-3);
}

// Share of a disc in the map that does not hide the receiver, by kTgSoftTaps. radius: texels; the others as below.
float tgShadowDisc(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth, float2 slope, float2 size, float radius, float turn)
{
    float lit = 0.0;
    [loop] for (int i = 0; i < kTgSoftTaps; i++)
    {
        float2 offset = radius * tgSoftTap(i, kTgSoftTaps, turn);
        float2 depths = tgSoftDepths(TG_SAMPLER2D_ARG(map), coordinate, offset, depth, slope, size);
        lit += step(depths.x, depths.y);
    }
    return tgShadowBeyond(coordinate) > 0.0 ? 1.0 : lit / kTgSoftTaps;
}

// Share of the light that is seen. depth: less tolerance; slope: mm from texel to texel; footprint: mm of a texel; nearest: mm from the
// light to the nearest thing that may hide it; turn: of the taps, rad.
float tgShadowSoft(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth, float2 slope, float footprint, float2 size, float nearest,
                   float turn)
{
    float search = max(tgSoftWidth(size, depth - nearest, nearest) / footprint, kTgSoftNarrowest);
    float hiding = 0.0;
    float widths = 0.0;
    [loop] for (int i = 0; i < kTgSoftSearch; i++)
    {
        float2 offset = search * tgSoftTap(i, kTgSoftSearch, turn);
        float2 depths = tgSoftDepths(TG_SAMPLER2D_ARG(map), coordinate, offset, depth, slope, size);
        float width = max(tgSoftWidth(size, depth - depths.y, depths.y) / footprint, kTgSoftNarrowest);
        float hides = step(depths.y, depths.x) * step(length(offset), width);
        hiding += hides;
        widths += hides * width;
    }
    float radius = max(widths / max(hiding, 1.0), kTgSoftNarrowest);
    return tgShadowDisc(TG_SAMPLER2D_ARG(map), coordinate, depth, slope, size, radius, turn);
}

#endif
