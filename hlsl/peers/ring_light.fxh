// Light around a ring: L = the profile's marginal, sum of w_i N(0, v_i), over 10 mm to both sides, as NVIDIA FaceWorks (2014) tabulates it
// (in 200 steps).
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PEERS_RING_FXH
#include "../peers/ring.fxh"
#endif
#ifndef TEGUMENT_PEERS_RING_LIGHT_FXH
#define TEGUMENT_PEERS_RING_LIGHT_FXH

// Midpoints of the steps, both sides at once; the profile is 1e-5 at the ends.
float3 tgPreintegratedScattered(float4 gaussians[6], float angle, float curvature)
{
    float3 sum = float3(0.0, 0.0, 0.0);
    float step = kTgPreintegratedReach / kTgPreintegratedSteps;
    [loop] for (int i = 0; i < kTgPreintegratedSteps; i++)
    {
        float x = (i + 0.5) * step;
        sum += tgPreintegratedPair(angle, x * curvature) * step * tgPreintegratedProfile(gaussians, x, 1.0);
    }
    return sum;
}

// Per mm, from what neighbouring pixels see: mean curvature over the pixel's two directions, hollows 0.
float tgPreintegratedCurvature(float3 normal, float3 world)
{
    float3 nx = ddx(normal);
    float3 ny = ddy(normal);
    float3 px = ddx(world);
    float3 py = ddy(world);
    float curvature = (dot(nx, px) + dot(ny, py)) / max(dot(px, px) + dot(py, py), 1e-12);
    return max(curvature, 0.0);
}

#endif
// SPDX-License-Identifier: MIT
