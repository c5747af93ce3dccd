// scatter/transmission.fxh as the seed prints it (equation 39): alpha is the depth itself, in units of the light's depth range, the
// exponent lacks its 1/2, and nothing fades near the lit side.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SCATTER_THICKNESS_FXH
#include "../scatter/thickness.fxh"
#endif
#ifndef TEGUMENT_PRINTED_TRANSMISSION_FXH
#define TEGUMENT_PRINTED_TRANSMISSION_FXH

// What is no number, as the thickness by a normal that is none, is opaque: it must not reach the neighbours.
float tgTransmissionEncode(float thickness)
{
    float known = thickness >= 0.0 ? thickness : kTgOpaqueDistance;
    return min(known, kTgLargestAlpha);
}

// range: mm between the light's planes.
float tgTransmissionDecode(float alpha, float range)
{
    return alpha * range;
}

float tgTransmissionShare(float thickness, float variance, float apart)
{
    float v = max(variance, kTgSmallestVariance);
    float exponent = thickness * thickness * 1.0 / v;
    return exponent < kTgNothingPasses ? exp(-exponent) : 0.0;
}

#endif
// SPDX-License-Identifier: MIT
