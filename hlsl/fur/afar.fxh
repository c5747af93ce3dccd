// Shells whose strands are narrower than a pixel. A fur map's coarser levels hold the mean height of what they cover; heights differ around
// it, and a layer covers the share of them that is taller than it is high. Heights are taken as logistic: the share below h is 1 / (1 +
// exp((mean - h) / scale)).
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_FUR_AFAR_FXH
#define TEGUMENT_FUR_AFAR_FXH

// Variance of heights within a footprint of the map. deviation: of all its heights. grain: footprint (both radians) that holds half of
// their variance. mean: there; heights cannot differ by much where hardly any strand stands.
float tgFurHeightVariance(float deviation, float grain, float footprint, float mean)
{
    float square = footprint * footprint;
    float variance = deviation * deviation * square / max(square + grain * grain, 1e-12);
    return min(variance, mean * mean);
}

// Mean slope of the heights, per radian. Cones drawn at several densities have 2.7 to 3.2 deviations per grain.
float tgFurHeightSlope(float deviation, float grain)
{
    return 2.8 * deviation / max(grain, 1e-6);
}

// Way over the skin on which a ray falls by 1. view: unit, towards the skin. strand: how the coat's point moves while its height rises by
// 1. Rays that rise along the skin, which interpolated normals bring about at silhouettes, are taken as falling with this cosine.
static const float kTgFurLeastFall = 0.02;
float tgFurWayOver(float3 view, float3 normal, float3 strand)
{
    float cosine = dot(view, normal);
    float rise = dot(strand, normal);
    return length((view - normal * cosine) * (rise / max(-cosine, kTgFurLeastFall)) + strand - normal * rise);
}

// 0: heights differ less than the soft ends of strands are long, and each texel is drawn by itself; 1: they are told by their mean and
// variance only.
float tgFurAfar(float variance, float softness)
{
    float end = 0.6 * softness; // across which light falls from 0.9 to 0.1 of what enters
    return 12.0 * variance / (12.0 * variance + end * end + 1e-8);
}

// Coverage of a layer over such heights, from what has passed the layer above. heights: of both. Seen along the strands, the shares above
// them overlap: 1 - (1 - share) / (1 - share of the layer above). A ray that falls across slopes of the mean size `slope` enters them more
// often, by the mean of max(1 + slope cos, 0) (B. Smith, 1967), here as a root that is near it; but never more often than if heights were
// independent in every layer.
float tgFurMeanCoverage(float mean, float2 heights, float variance, float softness, float slope)
{
    float scale = 0.5513 * sqrt(variance) + 1e-4; // sqrt(3) / pi
    float tip = mean + softness * (0.5 - min(0.2 * rsqrt(max(softness, 1e-6)), 1.0)); // where soft ends have taken half of the light
    float2 odds = 1.0 + exp(clamp((tip - heights) / scale, -60.0, 60.0));
    float share = 1.0 - 1.0 / odds.x;
    float entered = 1.0 - pow(odds.y / odds.x, 0.5 + sqrt(0.25 + slope * slope / (kTgPi * kTgPi)));
    float both = max(entered * entered * entered + share * share * share, 1e-20);
    return entered * share * pow(both, -1.0 / 3.0);
}

#endif
// SPDX-License-Identifier: MIT
