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
#ifndef TEGUMENT_SHADOW_BLOCKS_FXH
#include "../shadow/blocks.fxh"
#endif
#ifndef TEGUMENT_SHADOW_SOFT_FXH
#define TEGUMENT_SHADOW_SOFT_FXH

static const int kTgSoftSearch = 64;
static const int kTgSoftGlances = 32;
static const int kTgSoftTaps = 32;
// Cosine and sine of pi (3 - sqrt 5): neighbours in a spiral never line up.
static const float2 kTgSoftTurn = float2(-0.73736888, 0.67549029);
// The least radius of the filter, texels of the map: that of four taps 0.75 texels apart.
static const float kTgSoftNarrowest = 1.5;

// In 0..1, from pixel to pixel (Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare"). pixel: whole numbers.
float tgSoftNoise(float2 pixel)
{
    return frac(52.9829189 * frac(dot(floor(pixel), float2(0.06711056, 0.00583715))));
}

// The way of the first tap of a spiral, and from it and each the way of the next, unit. Tap i of n lies tgSoftShare(i, n) radii away: each
// for an equal area (Vogel 1979). turn: rad.
float2 tgSoftWay(float turn)
{
    return float2(cos(turn), sin(turn));
}

float2 tgSoftNext(float2 way)
{
    return float2(dot(way, float2(kTgSoftTurn.x, -kTgSoftTurn.y)), dot(way, kTgSoftTurn.yx));
}

float tgSoftShare(int i, int count)
{
    return sqrt((i + 0.5) / count);
}

// Distance of the receiver's plane, mm, at an offset in texels. From a point it is the reciprocal of what is linear in the map.
float tgSoftPlane(float2 offset, float depth, float2 slope, float2 size)
{
    float rise = dot(slope, offset);
    return depth + rise / max(1.0 - size.y * rise / max(depth, 1e-3), 0.05);
}

// What the map holds at an offset in texels.
float tgSoftStored(TG_SAMPLER2D_PARAM(map), float2 coordinate, float2 offset)
{
    float2 place = coordinate + offset / kTgShadowSize;
    float stored = tgShadowStored(TG_TEX2DLOD(map, float4(place, 0.0, 0.0))).x;
    return tgShadowBeyond(place) > 0.0 ? kTgNoSurface : stored;
}

// How far a place that hides some of the light may lie from the one that it is hidden from, mm in the map at the receiver's distance. gap:
// mm between the two along the axis; before: mm from the light to what hides it. size: of a light at a point its radius, mm, and 1; of
// parallel light the tangent of its half angle, and 0.
float tgSoftWidth(float2 size, float gap, float before)
{
    return size.x * gap / max(lerp(1.0, before, size.y), 1e-3);
}

// Share of a disc in the map that does not hide the receiver, by kTgSoftTaps. radius: texels; the others as below.
float tgShadowDisc(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth, float2 slope, float2 size, float radius, float2 way)
{
    float lit = 0.0;
    [loop] for (int i = 0; i < kTgSoftTaps; i++)
    {
        float2 offset = radius * tgSoftShare(i, kTgSoftTaps) * way;
        lit += step(tgSoftPlane(offset, depth, slope, size), tgSoftStored(TG_SAMPLER2D_ARG(map), coordinate, offset));
        way = tgSoftNext(way);
    }
    return tgShadowBeyond(coordinate) > 0.0 ? 1.0 : lit / kTgSoftTaps;
}

// The same, spared where the blocks of the map know it; in shader model 3 they are not asked.
float tgShadowDiscSpared(TG_SAMPLER2D_PARAM(map), TG_SAMPLER2D_PARAM(blocks), float2 coordinate, float depth, float2 slope, float2 size,
                         float radius, float2 way)
{
    float seen = 0.5;
    if (!kTgFewSlots)
        seen = tgShadowBlocks(TG_SAMPLER2D_ARG(blocks), coordinate, depth, slope, size, radius);
    [branch] if (seen == 0.5)
        seen = tgShadowDisc(TG_SAMPLER2D_ARG(map), coordinate, depth, slope, size, radius, way);
    return seen;
}

// Radius around the receiver in which something may hide the light, texels. nearest: mm from the light to the nearest thing that may.
float tgSoftReach(float depth, float footprint, float2 size, float nearest)
{
    return max(tgSoftWidth(size, depth - nearest, nearest) / footprint, kTgSoftNarrowest);
}

// Whether it is worth looking for what hides the light, 1 or 0: a glance at the map's blocks, each for all of its texels.
float tgSoftGlance(TG_SAMPLER2D_PARAM(blocks), float2 coordinate, float depth, float2 slope, float footprint, float2 size, float search,
                   float2 way)
{
    float found = 0.0;
    [loop] for (int i = 0; i < kTgSoftGlances; i++)
    {
        float away = search * tgSoftShare(i, kTgSoftGlances);
        float stored = tgShadowBlockAt(TG_SAMPLER2D_ARG(blocks), coordinate * kTgShadowSize + away * way).x;
        float width = max(tgSoftWidth(size, depth - stored, stored) / footprint, kTgSoftNarrowest) + kTgBlockTexels;
        found = max(found, step(stored, tgSoftPlane(away * way, depth, slope, size)) * step(away, width));
        way = tgSoftNext(way);
    }
    return found;
}

// Radius of the filter, texels: the mean width of what hides the light.
float tgSoftRadius(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth, float2 slope, float footprint, float2 size, float search,
                   float2 way)
{
    float hiding = 0.0;
    float widths = 0.0;
    [loop] for (int i = 0; i < kTgSoftSearch; i++)
    {
        float away = search * tgSoftShare(i, kTgSoftSearch);
        float stored = tgSoftStored(TG_SAMPLER2D_ARG(map), coordinate, away * way);
        float width = max(tgSoftWidth(size, depth - stored, stored) / footprint, kTgSoftNarrowest);
        float hides = step(stored, tgSoftPlane(away * way, depth, slope, size)) * step(away, width);
        hiding += hides;
        widths += hides * width;
        way = tgSoftNext(way);
    }
    return max(widths / max(hiding, 1.0), kTgSoftNarrowest);
}

// Share of the light that is seen. depth: less tolerance; slope: mm from texel to texel; footprint: mm of a texel; nearest as above;
// way: of the first tap, from tgSoftWay().
float tgShadowSoft(TG_SAMPLER2D_PARAM(map), TG_SAMPLER2D_PARAM(blocks), float2 coordinate, float depth, float2 slope, float footprint,
                   float2 size, float nearest, float2 way)
{
    float search = tgSoftReach(depth, footprint, size, nearest);
    float radius = kTgSoftNarrowest;
    float found = 1.0;
    if (!kTgFewSlots)
        found = tgSoftGlance(TG_SAMPLER2D_ARG(blocks), coordinate, depth, slope, footprint, size, search, way);
    [branch] if (found > 0.0)
        radius = tgSoftRadius(TG_SAMPLER2D_ARG(map), coordinate, depth, slope, footprint, size, search, way);
    return tgShadowDiscSpared(TG_SAMPLER2D_ARG(map), TG_SAMPLER2D_ARG(blocks), coordinate, depth, slope, size, radius, way);
}

#endif
// SPDX-License-Identifier: MIT
