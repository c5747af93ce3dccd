// Thickness of the body where light passes through it (d'Eon and Luebke 2007, "Modified translucent shadow maps"), and lengths on its
// surface. Units: mm.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SCATTER_THICKNESS_FXH
#define TEGUMENT_SCATTER_THICKNESS_FXH

// exp(-50) is 2e-22. Smaller shares would only bring denormal numbers, which processors may or may not flush.
static const float kTgNothingPasses = 50.0;
// mm^2, a micrometre wide: an artist may turn a Gaussian off by a variance of 0, and 0 / 0 would be no number.
static const float kTgSmallestVariance = 1e-6;

// Depth along the light's ray turned into thickness of a flat slab: cosine correction in so far as the lit side is parallel to this one.
// cosine = N.L here; litNormal = normal where the light entered. No thickness where the light reaches the surface directly.
float tgTransmissionThickness(float path, float cosine, float3 normal, float3 litNormal)
{
    float parallel = saturate(-dot(litNormal, normal));
    float corrected = saturate(-cosine) * path;
    return cosine > 0.0 ? kTgOpaqueDistance : lerp(path, corrected, parallel);
}

// mm of surface per unit of uv, from what neighbouring pixels see.
float tgTransmissionScale(float3 world, float2 uv)
{
    float area = length(cross(ddx(world), ddy(world)));
    float2 dx = ddx(uv);
    float2 dy = ddy(uv);
    return sqrt(area / max(abs(dx.x * dy.y - dx.y * dy.x), 1e-12));
}

#endif
// SPDX-License-Identifier: MIT
