// Pre-integrated skin shading (Penner and Borshukov, Pre-integrated skin shading, GPU Pro 2, 2011; Penner, SIGGRAPH 2010): light scattered
// around a ring of the surface's own radius, in a table over N.L and curvature.
//   D(theta, rho) = integral of max(cos(theta + x / rho), 0) L(x) dx,   x along the ring, mm
// The table holds D - max(cos(theta), 0), which is small and has no edge to interpolate over.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SURFACE_NORMAL_FXH
#include "../surface/normal.fxh"
#endif
#ifndef TEGUMENT_PEERS_RING_FXH
#include "../peers/ring.fxh"
#endif
#ifndef TEGUMENT_PEERS_RING_LIGHT_FXH
#include "../peers/ring_light.fxh"
#endif
#ifndef TEGUMENT_PRINTED_PREINTEGRATED_FXH
#include "../printed/preintegrated.fxh"
#endif
#ifndef TEGUMENT_PEERS_PREINTEGRATED_FXH
#define TEGUMENT_PEERS_PREINTEGRATED_FXH

// Texels over N.L = -1..1 (odd: one stands on 0) and over the curvature.
static const float2 kTgPreintegratedSize = float2(257.0, 65.0);
// Per mm: a radius of 2 mm, that of a nostril's wing.
static const float kTgPreintegratedSharpest = 0.5;
// mm over which light reaches around the edge of a body.
static const float kTgOwnShadowReach = 10.0;
// N.L at which light grazes the surface.
static const float kTgEdgeOn = 0.1;

// What a texel of the table holds. cosine = N.L.
float3 tgPreintegratedTexel(float4 gaussians[6], float cosine, float curvature)
{
    float angle = acos(clamp(cosine, -1.0, 1.0));
    float3 light = tgPreintegratedScattered(gaussians, angle, curvature);
    return light - saturate(cosine);
}

// N.L and curvature of a place in the table, and back.
float2 tgPreintegratedArguments(float2 uv)
{
    float2 place = saturate((uv * kTgPreintegratedSize - 0.5) / (kTgPreintegratedSize - 1.0));
    return float2(place.x * 2.0 - 1.0, place.y * kTgPreintegratedSharpest);
}

float2 tgPreintegratedCoordinate(float cosine, float curvature)
{
    float2 place = saturate(float2(0.5 * cosine + 0.5, curvature / kTgPreintegratedSharpest));
    return (place * (kTgPreintegratedSize - 1.0) + 0.5) / kTgPreintegratedSize;
}

// A bump that is narrower than the diffusion does not show in it: each colour has a normal of its own between the mesh's and the map's.
// share = what is left of it.
float3 tgPreintegratedCosines(float3 meshNormal, float3 normal, float3 toLight, float3 share)
{
    float3 red = tgSafeNormalize(lerp(meshNormal, normal, share.r));
    float3 green = tgSafeNormalize(lerp(meshNormal, normal, share.g));
    float3 blue = tgSafeNormalize(lerp(meshNormal, normal, share.b));
    return float3(dot(red, toLight), dot(green, toLight), dot(blue, toLight));
}

// Light diffused around the ring, of each colour.
float3 tgPreintegratedLight(TG_SAMPLER2D_PARAM(table), float3 cosines, float curvature)
{
    float3 around = float3(TG_TEX2DLOD(table, float4(tgPreintegratedCoordinate(cosines.r, curvature), 0.0, 0.0)).r,
                           TG_TEX2DLOD(table, float4(tgPreintegratedCoordinate(cosines.g, curvature), 0.0, 0.0)).g,
                           TG_TEX2DLOD(table, float4(tgPreintegratedCoordinate(cosines.b, curvature), 0.0, 0.0)).b);
    return max(saturate(cosines) + around, 0.0);
}

// mm by which the body's own front may lie before a point that has turned away from the light and yet counts as lit: the chord of its ring,
// and a quarter for what is not a ring. Without it the shadow map would cut off what the table has brought around. It begins before the
// terminator, where the map's texels lie edge-on.
float tgPreintegratedTolerance(float cosine, float curvature)
{
    return min(2.5 * max(kTgEdgeOn - cosine, 0.0) / max(curvature, kTgPreintegratedFlattest), kTgOwnShadowReach);
}

#endif
// SPDX-License-Identifier: MIT
