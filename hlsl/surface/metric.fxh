// How a texel of a map in texture space lies on the surface: the whole first fundamental form, not only lengths along U and V, so that
// charts may be sheared. In texels a round kernel on the surface is an ellipse; its short axis is where a millimetre has the fewest
// texels.
#ifndef TEGUMENT_SURFACE_METRIC_FXH
#define TEGUMENT_SURFACE_METRIC_FXH

// A texel with less area than this (mm^2 along its longer side) belongs to a degenerate triangle.
static const float kTgSmallestTexelArea = 1e-6;
// Texels are stretched by at most so much, squared, that three taps can make up for it.
static const float kTgMostStretch = 9.0;

// alongU, alongV: mm, steps on the surface from texel to texel. xy: direction in which texels are dense, of length sqrt(k^2 - 1), k = how
// many times denser they are than across it; z: texels^2 per mm^2 where they are not. The eigenvectors of (E F; F G).
float3 tgMetric(float3 alongU, float3 alongV)
{
    float e = dot(alongU, alongU);
    float f = dot(alongU, alongV);
    float g = dot(alongV, alongV);
    float mean = 0.5 * (e + g);
    float apart = sqrt(max(0.25 * (e - g) * (e - g) + f * f, 0.0));
    float large = max(mean + apart, kTgSmallestTexelArea);
    float small = max(mean - apart, large / kTgMostStretch);
    float2 dense = abs(e - mean + apart) > abs(g - mean + apart) ? float2(-f, e - mean + apart) : float2(g - mean + apart, -f);
    float length2 = dot(dense, dense);
    float2 direction = length2 > 1e-20 * large * large ? dense * rsqrt(max(length2, 1e-36)) : float2(1.0, 0.0);
    return float3(direction * sqrt(max(large / small - 1.0, 0.0)), 1.0 / large);
}

#endif
// SPDX-License-Identifier: MIT
