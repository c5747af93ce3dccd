// peers/ring_light.fxh as the listing of GPU Pro 2 prints it.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PEERS_RING_FXH
#include "../peers/ring.fxh"
#endif
#ifndef TEGUMENT_PRINTED_PREINTEGRATED_FXH
#define TEGUMENT_PRINTED_PREINTEGRATED_FXH

// What the listing multiplies variances with.
static const float kTgPrintedVariance = 1.414;

// The listing's integral: half a turn, chords 2 rho sin(x / 2), the radial profile's weights on a line, variances times 1.414, normalised.
// Its steps are laid where the profile is, instead of over the whole half turn.
float3 tgPreintegratedScattered(float4 gaussians[6], float angle, float curvature)
{
    float bent = max(curvature, kTgPreintegratedFlattest);
    float reach = min(2.0 * asin(min(0.5 * kTgPreintegratedReach * bent, 1.0)), 0.5 * kTgPi);
    float3 sum = float3(0.0, 0.0, 0.0);
    float3 total = float3(0.0, 0.0, 0.0);
    [loop] for (int i = 0; i < kTgPreintegratedSteps; i++)
    {
        float x = (i + 0.5) / kTgPreintegratedSteps * reach;
        float3 weight = tgPreintegratedProfile(gaussians, 2.0 * sin(0.5 * x) / bent, kTgPrintedVariance);
        sum += tgPreintegratedPair(angle, x) * weight;
        total += 2.0 * weight;
    }
    return sum / max(total, 1e-20);
}

// Per mm: lengths of the sums of changes.
float tgPreintegratedCurvature(float3 normal, float3 world)
{
    float3 nx = ddx(normal);
    float3 ny = ddy(normal);
    float3 px = ddx(world);
    float3 py = ddy(world);
    return length(abs(nx) + abs(ny)) / max(length(abs(px) + abs(py)), 1e-6);
}

#endif
// SPDX-License-Identifier: MIT
