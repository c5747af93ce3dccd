// Shadows from a map of distances to the plane through the light, across its axis: linear over a triangle, so that a pass has one number to
// interpolate. The filters are as wide as the first Gaussian of skin, or as a texel of the map that receives the light. What lies outside
// of the map is lit. axis: where the light looks, a unit vector.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SHADOW_MAP_FXH
#include "../shadow/map.fxh"
#endif
#ifndef TEGUMENT_SHADOW_PLANAR_FXH
#define TEGUMENT_SHADOW_PLANAR_FXH

// Smallest share of the light's axis that slopes are computed with; below it the receiver is seen edge-on.
static const float kTgSmallestPlanarCosine = 0.15;
// N.L of the mesh at which its own horizon has passed.
static const float kTgPlanarHorizon = 0.01;
// Share of a texel's slope that is left to facets, which are steeper than their normals say.
static const float kTgPlanarFacets = 0.25;
// How far a texel's middle is at most from a look-up in it, and from one that takes the four nearest, texels.
static const float kTgPlanarTexel = 0.7072;
static const float kTgPlanarNearest = 1.0;
// Texels of the map (mm) up to which 4 x 4 taps are wider than the four nearest texels, and the distance of those taps on the surface, mm:
// four of them in a row have the variance of the first Gaussian, 5/4 of its square.
static const float kTgNarrowTexel = 0.15;
static const float kTgNarrowStep = 0.0716;
// Cosine and sine of the turn of a 4 x 4 grid by atan(1/4): along the axes its 16 points are equally far apart.
static const float2 kTgTurn = float2(0.9701425, 0.2425356);

// Distance to the plane through the light, mm; before its near plane 0: what lies there, or behind the light, is lit.
float tgShadowPlanarDepth(float4 lightClip, float3 toLight, float3 axis)
{
    return lightClip.z > 0.0 ? -dot(toLight, axis) : 0.0;
}

// Change of that distance (mm) from texel to texel along u and v on the plane through the receiver. On the ray through the neighbouring
// texel the distance to the plane changes by footprint * n.x / (n.l / l.a): exact under perspective and for parallel light.
float2 tgShadowPlanarSlope(float3 normal, float3 axisX, float3 axisY, float3 toLight, float3 axis, float footprint)
{
    float facing = dot(normal, toLight) / max(-dot(toLight, axis), 1e-3);
    float scale = footprint / max(facing, kTgSmallestPlanarCosine);
    return facing > 0.0 ? scale * float2(dot(normal, axisX), -dot(normal, axisY)) : float2(0.0, 0.0);
}

// Texels by which a look-up moves outwards where the slope is steeper than it is followed: by `texels`, within which the surface itself
// would stand before that plane. What hides the light from there is something else, however thin; a plane that is followed farther down
// would pass beneath. slope: of tgShadowPlanarSlope.
float2 tgShadowPlanarAside(float3 normal, float3 toLight, float3 axis, float2 slope, float texels)
{
    float facing = dot(normal, toLight) / max(-dot(toLight, axis), 1e-3);
    float steep = saturate(2.0 - 2.0 * facing / kTgSmallestPlanarCosine);
    return texels * steep * slope * rsqrt(max(dot(slope, slope), 1e-12));
}

// A surface that turns away from the light is shadowed by itself.
float tgShadowPlanarHorizon(float cosine)
{
    return saturate(cosine / kTgPlanarHorizon);
}

// The four nearest texels, interpolated: as sharp as the map. depth: less tolerance.
float tgShadowSharp(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth, float2 slope)
{
    float2 position = coordinate * kTgShadowSize - 0.5;
    float2 f = frac(position);
    float2 corner = (position - f + 0.5) / kTgShadowSize;
    float2 far = corner + 1.0 / kTgShadowSize;
    float4 texel;
    texel.x = TG_TEX2DLOD(map, float4(corner, 0.0, 0.0)).x;
    texel.y = TG_TEX2DLOD(map, float4(far.x, corner.y, 0.0, 0.0)).x;
    texel.z = TG_TEX2DLOD(map, float4(corner.x, far.y, 0.0, 0.0)).x;
    texel.w = TG_TEX2DLOD(map, float4(far, 0.0, 0.0)).x;
    float4 plane = depth + slope.x * (float4(0.0, 1.0, 0.0, 1.0) - f.x) + slope.y * (float4(0.0, 0.0, 1.0, 1.0) - f.y);
    float lit = dot(step(plane, tgShadowStored(texel)),
                    float4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y));
    return tgShadowBeyond(coordinate) > 0.0 ? 1.0 : lit;
}

// 4 x 4 taps over a square on the receiver's own plane, `apart` mm from each other; each texel is held against that plane at its own
// middle. The square is turned against the light's right, so that an edge along the map's axes meets the taps one by one. depth: less
// tolerance; slope: of that plane; footprint: mm of a texel of the map.
float tgShadowOnPlane(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth, float2 slope, float3 normal, float3 axisX, float3 axisY,
                      float3 axis, float footprint, float apart)
{
    float3 right = axisX - normal * dot(normal, axisX);
    float3 side = right * rsqrt(max(dot(right, right), 1e-12));
    float3 other = cross(normal, side);
    float3 u = apart * (kTgTurn.x * side + kTgTurn.y * other);
    float3 v = apart * (kTgTurn.x * other - kTgTurn.y * side);
    float scale = 1.0 / footprint;
    float2 alongU = scale * float2(dot(u, axisX), -dot(u, axisY));
    float2 alongV = scale * float2(dot(v, axisX), -dot(v, axisY));
    // What the plane through the taps falls beside `slope`, which is not followed as far down.
    float2 beside = float2(dot(u, axis) - dot(slope, alongU), dot(v, axis) - dot(slope, alongV));
    // All of it counted from the texel of the look-up: whole numbers stay small.
    float2 within = frac(coordinate * kTgShadowSize);
    float2 middle = coordinate + (0.5 - within) / kTgShadowSize;
    float4 across = float4(-1.5, -0.5, 0.5, 1.5);
    float4 acrossX = within.x + alongU.x * across;
    float4 acrossY = within.y + alongU.y * across;
    float4 acrossZ = depth + dot(slope, 0.5 - within) + beside.x * across;
    float sum = 0.0;
    [unroll] for (int j = 0; j < 4; j++)
    {
        float4 x = floor(acrossX + (j - 1.5) * alongV.x);
        float4 y = floor(acrossY + (j - 1.5) * alongV.y);
        float4 row;
        [unroll] for (int i = 0; i < 4; i++)
            row[i] = TG_TEX2DLOD(map, float4(middle + float2(x[i], y[i]) / kTgShadowSize, 0.0, 0.0)).x;
        float4 plane = acrossZ + (j - 1.5) * beside.y + slope.x * x + slope.y * y;
        sum += dot(step(plane, tgShadowStored(row)), 0.0625);
    }
    return tgShadowBeyond(coordinate) > 0.0 ? 1.0 : sum;
}

#endif
// SPDX-License-Identifier: MIT
