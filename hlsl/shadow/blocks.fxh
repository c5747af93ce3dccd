// A map of distances in blocks of 8 x 8 texels: of each the plane that none of them lies before, and how far behind it they reach. Where
// all that a filter could touch lies behind the receiver's plane, or all before it, a few fetches say so for sure.
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
#define TEGUMENT_SHADOW_BLOCKS_FXH

static const int kTgBlockTexels = 8;
static const float kTgBlocks = (TEGUMENT_SHADOW_SIZE + 7) / 8;
// Sum of x^2 over the texels of a block, x from -3.5 to 3.5.
static const float kTgBlockMoment = 336.0;

// Texel number i of a block, from its middle, and what the map holds there.
float3 tgBlockTexel(TG_SAMPLER2D_PARAM(map), float2 block, int i)
{
    float2 place = float2(fmod(i, 8.0), floor((i + 0.5) / 8.0));
    float2 coordinate = (kTgBlockTexels * block + place + 0.5) / kTgShadowSize;
    return float3(place - 3.5, tgShadowStored(TG_TEX2DLOD(map, float4(coordinate, 0.0, 0.0))).x);
}

// x: distance at the block's middle of a plane that no texel lies before, mm; yz: its change from texel to texel along u and v; w: how far
// behind it they reach. The plane has the least squares' slope, or none where the map holds no surface somewhere. block: whole numbers.
float4 tgShadowBlock(TG_SAMPLER2D_PARAM(map), float2 block)
{
    float first = tgBlockTexel(TG_SAMPLER2D_ARG(map), block, 0).z;
    float2 slope = 0.0;
    float furthest = first;
    [loop] for (int i = 1; i < kTgBlockTexels * kTgBlockTexels; i++)
    {
        float3 texel = tgBlockTexel(TG_SAMPLER2D_ARG(map), block, i);
        slope += texel.xy * (texel.z - first);
        furthest = max(furthest, texel.z);
    }
    slope = furthest < kTgNoSurface ? slope / kTgBlockMoment : float2(0.0, 0.0);
    float least = kTgNoSurface;
    float most = 0.0;
    [loop] for (int j = 0; j < kTgBlockTexels * kTgBlockTexels; j++)
    {
        float3 texel = tgBlockTexel(TG_SAMPLER2D_ARG(map), block, j);
        float distance = texel.z - dot(slope, texel.xy);
        least = min(least, distance);
        most = max(most, distance);
    }
    return float4(least, slope, most - least);
}

// The block at a place in the map, in texels, with its distance there.
float4 tgShadowBlockAt(TG_SAMPLER2D_PARAM(blocks), float2 texels)
{
    float2 block = clamp(floor(texels / kTgBlockTexels), 0.0, kTgBlocks - 1.0);
    float4 found = TG_TEX2DLOD(blocks, float4((block + 0.5) / kTgBlocks, 0.0, 0.0));
    float2 away = texels - kTgBlockTexels * (block + 0.5);
    return float4(found.x + dot(found.yz, away), found.yzw);
}

// 1 where no texel of the block that the filter could touch hides the receiver, 0 where all do; else 0.5. bend: mm by which the receiver's
// plane at most leaves its slope. A tap sees the texel that it falls into, up to half a texel aside.
float tgShadowBlockSays(float4 block, float depth, float2 slope, float bend, float radius)
{
    float reach = radius * length(slope - block.yz) + 0.5 * (abs(block.y) + abs(block.z));
    float before = depth + bend + reach <= block.x ? 1.0 : 0.5;
    return depth - reach > block.x + block.w ? 0.0 : before;
}

// Of the disc that tgShadowDisc() asks, by the four blocks around it: 1 all lit, 0 all hidden, else 0.5: taps have to tell. radius: at most
// half a block, or it is not known. The rest as there.
float tgShadowBlocks(TG_SAMPLER2D_PARAM(blocks), float2 coordinate, float depth, float2 slope, float2 size, float radius)
{
    float2 texels = coordinate * kTgShadowSize;
    float rise = length(slope) * radius;
    float share = size.y / max(depth, 1e-3);
    float bend = share * rise * rise / max(1.0 - share * rise, 0.05);
    float4 says = 0.5;
    [unroll] for (int i = 0; i < 4; i++)
    {
        float2 corner = texels + radius * float2(i % 2 == 0 ? -1.0 : 1.0, i < 2 ? -1.0 : 1.0);
        float4 block = tgShadowBlockAt(TG_SAMPLER2D_ARG(blocks), corner);
        block.x -= dot(block.yz, corner - texels);
        says[i] = tgShadowBlockSays(block, depth, slope, bend, radius);
    }
    float least = min(min(says.x, says.y), min(says.z, says.w));
    float most = max(max(says.x, says.y), max(says.z, says.w));
    float2 edge = radius / kTgShadowSize;
    bool inside = tgShadowBeyond(coordinate - edge) + tgShadowBeyond(coordinate + edge) <= 0.0;
    bool known = radius <= 0.5 * kTgBlockTexels && least == most && (inside || least > 0.5);
    return known ? least : 0.5;
}

#endif
// SPDX-License-Identifier: MIT
