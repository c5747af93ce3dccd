// What both forms of pre-integrated skin share: a ring of the surface's own radius, and the profile of six Gaussians on a line. Lengths in
// mm.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PEERS_RING_FXH
#define TEGUMENT_PEERS_RING_FXH

// A flat surface has no ring. 10 m.
static const float kTgPreintegratedFlattest = 1e-4;
// To one side; shader model 3 loops at most 255 times.
static const int kTgPreintegratedSteps = 200;
static const float kTgPreintegratedReach = 10.0;

// Sum of weight * N(0, variance) of one Gaussian: rgb weights, w variance.
float3 tgPreintegratedGaussian(float4 gaussian, float distance, float scale)
{
    float variance = max(gaussian.w * scale, 1e-6);
    return gaussian.rgb * (exp(-0.5 * distance * distance / variance) * rsqrt(2.0 * kTgPi * variance));
}

float3 tgPreintegratedProfile(float4 gaussians[6], float distance, float scale)
{
    float3 sum = float3(0.0, 0.0, 0.0);
    [unroll] for (int i = 0; i < 6; i++)
        sum += tgPreintegratedGaussian(gaussians[i], distance, scale);
    return sum;
}

// Light at both ends of an arc around the angle.
float tgPreintegratedPair(float angle, float arc)
{
    return saturate(cos(angle + arc)) + saturate(cos(angle - arc));
}

#endif
// SPDX-License-Identifier: MIT
