// Which texels a needed texel draws light from: those within the reach of the blurs. Kept per tile; the map has kTgCullTiles tiles a side.
// A tile holds (1 where needed, largest texels per mm along U, along V, 1). U first, then V: what the boxes of all the convolutions cover.
// A reach is (mm on the surface, texels besides).
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SCATTER_GAUSSIAN_FXH
#include "../scatter/gaussian.fxh"
#endif
#ifndef TEGUMENT_PRINTED_GAUSSIAN_FXH
#include "../printed/gaussian.fxh"
#endif
#ifndef TEGUMENT_SCATTER_POISSON_FXH
#include "../scatter/poisson.fxh"
#endif
#ifndef TEGUMENT_PRINTED_POISSON_FXH
#include "../printed/poisson.fxh"
#endif
#ifndef TEGUMENT_CULL_REACH_FXH
#define TEGUMENT_CULL_REACH_FXH

static const int kTgCullTiles = 64;
static const int kTgTileTexels = (TEGUMENT_MAP_SIZE + kTgCullTiles - 1) / kTgCullTiles;
// Texels: those between which the last pass looks up; those that a convolution adds, for its taps are interpolated (1) and reach 3 at least
// outside the charts.
static const float kTgLookUpReach = 2.0;
static const float kTgConvolutionReach = 3.0;
// Whether a texel is needed is asked at its centre; the tile beside it may hold the rest of it.
static const float kTgTileSlack = 2.0;

// Three spacings of every Gaussian of the cascade.
float2 tgReachOfCascade(float4 sigma1To4, float2 sigma5And6)
{
    float4 after = float4(sigma1To4.yzw, sigma5And6.x);
    float4 before = sigma1To4;
    float4 steps = sqrt(max(after * after - before * before, 0.0));
    float last = sqrt(max(sigma5And6.y * sigma5And6.y - sigma5And6.x * sigma5And6.x, 0.0));
    return float2(3.0 * (steps.x + steps.y + steps.z + steps.w + last), 5.0 * kTgConvolutionReach + kTgLookUpReach);
}

// The radii of `count` Poisson blurs where the kernel size is 1.
float2 tgReachOfBlurs(float size, float count)
{
    return tgPoissonReach(size, count) + float2(0.0, kTgLookUpReach);
}

// Needs, densities of the map, largest over a tile; uv: any point of the tile's middle. The densities outside the charts count too: texels
// there are filled by the same convolutions.
float4 tgReachTile(TG_SAMPLER2D_PARAM(need), TG_SAMPLER2D_PARAM(stretch), float2 uv)
{
    float2 corner = floor(uv * kTgCullTiles) / kTgCullTiles + 0.5 / kTgMapSize;
    float4 largest = 0.0;
    [loop] for (int j = 0; j < kTgTileTexels; j++)
        [loop] for (int i = 0; i < kTgTileTexels; i++)
        {
            float4 texel = float4(corner + float2(i, j) / kTgMapSize, 0.0, 0.0);
            largest = max(largest, float4(TG_TEX2DLOD(need, texel).x, tgGaussianDensity(TG_TEX2DLOD(stretch, texel)), 1.0));
        }
    return largest;
}

// 1 if a needed tile this way reaches here. The density is the largest met on the way. axis: one tile, in uv; select: (1, 0) along U, (0,
// 1) along V.
float tgReachFrom(TG_SAMPLER2D_PARAM(tiles), float2 uv, float2 axis, float2 select, float2 reach)
{
    float density = 0.0;
    float needed = 0.0;
    [loop] for (int k = 0; k < kTgCullTiles; k++)
    {
        float4 tile = TG_TEX2DLOD(tiles, float4(uv + k * axis, 0.0, 0.0));
        density = max(density, dot(tile.yz, select));
        needed = (k - kTgTileSlack) * kTgTileTexels <= reach.x * density + reach.y ? max(needed, tile.x) : needed;
    }
    return needed;
}

float4 tgReachAlong(TG_SAMPLER2D_PARAM(tiles), float2 uv, float2 select, float2 reach)
{
    float2 axis = select / kTgCullTiles;
    float needed = max(tgReachFrom(TG_SAMPLER2D_ARG(tiles), uv, axis, select, reach),
        tgReachFrom(TG_SAMPLER2D_ARG(tiles), uv, -axis, select, reach));
    return float4(needed, TG_TEX2DLOD(tiles, float4(uv, 0.0, 0.0)).yz, 1.0);
}

#endif
