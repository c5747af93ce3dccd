// The test against a shadow map: what its texels hold, on what plane the receiver lies, and a filter that compares each texel with that
// plane. Depth: the distance to the light in mm, so that along one ray the difference of two depths is a length; of parallel light the
// distance to the plane of its position. Before the light's near plane it is 0: what lies there, or behind the light, is lit.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SHADOW_MAP_FXH
#include "../shadow/map.fxh"
#endif
#ifndef TEGUMENT_SHADOW_FILTER_FXH
#define TEGUMENT_SHADOW_FILTER_FXH

// Smallest N.L that slopes are computed with. Below it the receiving plane is seen edge-on: its depth would change without limit within a
// texel.
static const float kTgSmallestSlopeCosine = 0.15;
// Share of a texel's slope that remains as tolerance, for a curved surface is not the plane it is taken for.
static const float kTgSlopeTolerance = 1.0;
// N.L of the mesh at which its own horizon has passed.
static const float kTgHorizon = 0.05;

float tgShadowDepth(float4 lightClip, float3 toLight)
{
    return lightClip.z > 0.0 ? length(toLight) : 0.0;
}

// Change of depth (mm) from texel to texel along u and v on the plane through the receiver; the inverse of tgTsmNormal. axisX, axisY: the
// light's right and up. The ray of the next texel is turned by the footprint along the axis; the distance to where it meets the plane
// changes by axis.(n / n.l - l) of it. The second term is that of a sphere around the light, on which no distance changes; for parallel
// light it is 0.
float2 tgShadowSlope(float3 normal, float3 axisX, float3 axisY, float3 toLight, float footprint)
{
    float cosine = dot(normal, toLight);
    float3 across = footprint * (normal / max(cosine, kTgSmallestSlopeCosine) - toLight);
    return cosine > 0.0 ? float2(dot(across, axisX), -dot(across, axisY)) : float2(0.0, 0.0);
}

// A surface that turns away from the light is shadowed by itself, whatever its normal map says and the map's texels can resolve.
float tgShadowHorizon(float cosine)
{
    return saturate(cosine / kTgHorizon);
}

// 1 where four texels from `first` on, counted in texels, lie on the map.
float4 tgShadowOnMap(float first)
{
    float4 texel = first + float4(0.0, 1.0, 2.0, 3.0);
    return step(-0.5, texel) * step(texel, kTgShadowSize - 0.5);
}

// Box three texels wide over bilinear comparisons: 4 x 4 taps weighted (1 - f, 1, 1, f) in both directions, each compared with the
// receiver's plane there. Taps outside of the map are lit.
float tgShadowFiltered(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth, float2 slope)
{
    float2 position = coordinate * kTgShadowSize - 0.5;
    float2 f = frac(position);
    float2 corner = (position - f - 0.5) / kTgShadowSize;
    float4 columnWeight = tgShadowOnMap(position.x - f.x - 1.0) * float4(1.0 - f.x, 1.0, 1.0, f.x);
    float4 rowWeight = tgShadowOnMap(position.y - f.y - 1.0) * float4(1.0 - f.y, 1.0, 1.0, f.y);
    float4 plane = depth + slope.x * (float4(-1.0, 0.0, 1.0, 2.0) - f.x);
    float shadow = 0.0;
    [unroll] for (int j = 0; j < 4; j++)
    {
        float4 row;
        [unroll] for (int i = 0; i < 4; i++)
            row[i] = TG_TEX2DLOD(map, float4(corner + float2(i, j) / kTgShadowSize, 0.0, 0.0)).x;
        shadow += rowWeight[j] * dot(1.0 - step(plane + slope.y * (j - 1.0 - f.y), tgShadowStored(row)), columnWeight);
    }
    return 1.0 - shadow / 9.0;
}

// depth, tolerance: mm. slope: from tgShadowSlope.
float tgShadowTest(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth, float tolerance, float2 slope)
{
    float nearer = depth - tolerance - kTgSlopeTolerance * (abs(slope.x) + abs(slope.y));
    return tgShadowFiltered(TG_SAMPLER2D_ARG(map), coordinate, nearer, slope);
}

// A way across the light's rays that changes the map's place as much as one along `axis` would: `axis`, less its share along the ray.
float3 tgTsmAcross(float3 axis, float3 back, float3 toLight)
{
    return axis - back * (dot(toLight, axis) / max(dot(toLight, back), 1e-3));
}

#endif
// SPDX-License-Identifier: MIT
