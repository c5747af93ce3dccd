// A pyramid of maps in texture space: rgb light times coverage, alpha coverage, so that any filter of them is a mean over the charts.
// Quadratic B-splines: reduced by 1 3 3 1 along both axes, brought back by bilinear look-ups at half the step, which are their two-scale
// relation. size: texels along the side of the map that is read.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SCATTER_LADDER_FXH
#include "../scatter/ladder.fxh"
#endif
#ifndef TEGUMENT_SCATTER_PYRAMID_FXH
#define TEGUMENT_SCATTER_PYRAMID_FXH

// Below this a texel does not know its light; half floats of coverage are exact to 5e-4.
static const float kTgLeastCoverage = 1e-3;

// 1 3 3 1 along both axes: four bilinear look-ups, three quarters of a texel from the centre.
float4 tgPyramidReduce(TG_SAMPLER2D_PARAM(map), float2 uv, float size)
{
    float2 near = uv - 0.75 / size;
    float2 far = uv + 0.75 / size;
    return 0.25 * (TG_TEX2DLOD(map, float4(near, 0.0, 0.0)) + TG_TEX2DLOD(map, float4(far.x, near.y, 0.0, 0.0)) +
                   TG_TEX2DLOD(map, float4(near.x, far.y, 0.0, 0.0)) + TG_TEX2DLOD(map, float4(far, 0.0, 0.0)));
}

// The eight texels around one that no chart covers.
float4 tgPyramidAround(TG_SAMPLER2D_PARAM(map), float2 uv, float size)
{
    float4 sum = 0.0;
    [unroll] for (int j = -1; j <= 1; j++)
        [unroll] for (int i = -1; i <= 1; i++)
            if (i != 0 || j != 0)
                sum += TG_TEX2DLOD(map, float4(uv + float2(i, j) / size, 0.0, 0.0));
    return sum;
}

// Light of a level through a kernel that is round on the surface: where texels are denser along one direction than across it, 1 2 1 along
// that direction brings the variance there to that of the other. Alpha: the share of the kernel that lies on charts. metric:
// surface/metric.fxh, of the base; level: of the map.
float4 tgPyramidRound(TG_SAMPLER2D_PARAM(map), float2 uv, float size, float level, float2 metric)
{
    float2 step = sqrt(2.0 * tgLadderVariance(level) * exp2(-2.0 * level)) / size * metric;
    float4 sum = 0.5 * TG_TEX2DLOD(map, float4(uv, 0.0, 0.0)) +
                 0.25 * (TG_TEX2DLOD(map, float4(uv + step, 0.0, 0.0)) + TG_TEX2DLOD(map, float4(uv - step, 0.0, 0.0)));
    float covered = sum.w;
    if (sum.w < kTgLeastCoverage)
    {
        sum = tgPyramidAround(TG_SAMPLER2D_ARG(map), uv, size);
        covered = 0.125 * sum.w;
    }
    return float4(sum.w > 1e-6 ? sum.rgb / max(sum.w, 1e-6) : float3(0.0, 0.0, 0.0), covered);
}

#endif
// SPDX-License-Identifier: MIT
