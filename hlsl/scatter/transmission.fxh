// Light through thin parts (d'Eon and Luebke 2007, "Modified translucent shadow maps"). Since the profile is a sum of Gaussians,
// R(sqrt(r^2 + t^2)) = sum of w_i exp(-t^2 / (2 v_i)) G(v_i, r): the light convolved on the lit side, attenuated by thickness t, appears
// behind. Thickness travels in the alpha of the irradiance maps and is blurred with them. Units: mm.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SCATTER_THICKNESS_FXH
#include "../scatter/thickness.fxh"
#endif
#ifndef TEGUMENT_SCATTER_TRANSMISSION_FXH
#define TEGUMENT_SCATTER_TRANSMISSION_FXH

// What is no number, as the thickness by a normal that is none, is opaque: it must not reach the neighbours.
float tgTransmissionEncode(float thickness)
{
    float known = thickness >= 0.0 ? thickness : kTgOpaqueDistance;
    return min(exp(-kTgThicknessDecay * known), kTgLargestAlpha);
}

// range: mm between the light's planes. Alphas below 1e-6 (69 mm) are the half's denormals.
float tgTransmissionDecode(float alpha, float range)
{
    return -log(max(alpha, 1e-6)) / kTgThicknessDecay;
}

// Share of Gaussian `variance` that passes. apart = distance over the surface between the two points, mm: close to each other the
// convolution has already brought the light here.
float tgTransmissionShare(float thickness, float variance, float apart)
{
    float v = max(variance, kTgSmallestVariance);
    float exponent = thickness * thickness * 0.5 / v;
    float passed = exponent < kTgNothingPasses ? exp(-exponent) : 0.0;
    return passed * saturate(apart / (6.0 * sqrt(v)));
}

#endif
// SPDX-License-Identifier: MIT
