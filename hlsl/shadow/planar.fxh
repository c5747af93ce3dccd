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
// How far a texel's middle is at most from a look-up in it, texels.
static const float kTgPlanarTexel = 0.7072;
// How steeply visibility over the nearest 4 x 4 texels is drawn around a half.
static const float kTgPlanarSteep = 3.0;
// Texels of the map (mm) up to which 4 x 4 taps on the surface are wider than what is drawn of the nearest texels, and the distance of
// those taps, mm: four of them in a row have the variance of the first Gaussian, 5/4 of its square.
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

// 4 x 4 taps around a look-up: the way from one to the next along rows and columns, texels; what the receiver's plane falls on it beside
// its slope, mm; the weight of each column and row; how steeply what they see is drawn around a half.
struct TgShadowTaps
{
    float2 alongU;
    float2 alongV;
    float2 beside;
    float4 columns;
    float4 rows;
    float steep;
};

// Over a square on the receiver's own plane, `apart` mm from each other. The square is turned against the light's right, so that an edge
// along the map's axes meets the taps one by one. slope: of that plane; footprint: mm of a texel of the map.
TgShadowTaps tgShadowTapsOnPlane(float2 slope, float3 normal, float3 axisX, float3 axisY, float3 axis, float footprint, float apart)
{
    float3 right = axisX - normal * dot(normal, axisX);
    float3 side = right * rsqrt(max(dot(right, right), 1e-12));
    float3 other = cross(normal, side);
    float3 u = apart * (kTgTurn.x * side + kTgTurn.y * other);
    float3 v = apart * (kTgTurn.x * other - kTgTurn.y * side);
    float scale = 1.0 / footprint;
    TgShadowTaps taps;
    taps.alongU = scale * float2(dot(u, axisX), -dot(u, axisY));
    taps.alongV = scale * float2(dot(v, axisX), -dot(v, axisY));
    // What the plane through the taps falls beside `slope`, which is not followed as far down.
    taps.beside = float2(dot(u, axis) - dot(slope, taps.alongU), dot(v, axis) - dot(slope, taps.alongV));
    taps.columns = 0.25;
    taps.rows = 0.25;
    taps.steep = 1.0;
    return taps;
}

// The nearest texels, smoothed by a box of three over one of one: where that passes a half, the border of a shadow has no steps of the map.
// It is drawn about a texel wide.
TgShadowTaps tgShadowTapsOfTexels(float2 coordinate)
{
    float2 f = frac(coordinate * kTgShadowSize - 0.5);
    TgShadowTaps taps;
    taps.alongU = float2(1.0, 0.0);
    taps.alongV = float2(0.0, 1.0);
    taps.beside = 0.0;
    taps.columns = float4(1.0 - f.x, 1.0, 1.0, f.x) / 3.0;
    taps.rows = float4(1.0 - f.y, 1.0, 1.0, f.y) / 3.0;
    taps.steep = kTgPlanarSteep;
    return taps;
}

// Share of the taps that the light reaches; each texel is held against the receiver's plane at its own middle. depth: less tolerance.
float tgShadowTapped(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth, float2 slope, TgShadowTaps taps)
{
    // All of it counted from the texel of the look-up: whole numbers stay small.
    float2 within = frac(coordinate * kTgShadowSize);
    float2 middle = coordinate + (0.5 - within) / kTgShadowSize;
    float4 across = float4(-1.5, -0.5, 0.5, 1.5);
    float4 acrossX = within.x + taps.alongU.x * across;
    float4 acrossY = within.y + taps.alongU.y * across;
    float4 acrossZ = depth + dot(slope, 0.5 - within) + taps.beside.x * across;
    float sum = 0.0;
    [unroll] for (int j = 0; j < 4; j++)
    {
        float4 x = floor(acrossX + (j - 1.5) * taps.alongV.x);
        float4 y = floor(acrossY + (j - 1.5) * taps.alongV.y);
        float4 row;
        [unroll] for (int i = 0; i < 4; i++)
            row[i] = TG_TEX2DLOD(map, float4(middle + float2(x[i], y[i]) / kTgShadowSize, 0.0, 0.0)).x;
        float4 plane = acrossZ + (j - 1.5) * taps.beside.y + slope.x * x + slope.y * y;
        sum += taps.rows[j] * dot(step(plane, tgShadowStored(row)), taps.columns);
    }
    float lit = saturate(taps.steep * (sum - 0.5) + 0.5);
    return tgShadowBeyond(coordinate) > 0.0 ? 1.0 : lit;
}

// As sharp as the map. depth: less tolerance.
float tgShadowSharp(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth, float2 slope)
{
    return tgShadowTapped(TG_SAMPLER2D_ARG(map), coordinate, depth, slope, tgShadowTapsOfTexels(coordinate));
}

// As wide as taps on the surface. depth: less tolerance.
float tgShadowOnPlane(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth, float2 slope, float3 normal, float3 axisX, float3 axisY,
                      float3 axis, float footprint, float apart)
{
    return tgShadowTapped(TG_SAMPLER2D_ARG(map), coordinate, depth, slope,
                          tgShadowTapsOnPlane(slope, normal, axisX, axisY, axis, footprint, apart));
}

#endif
// SPDX-License-Identifier: MIT
