// The diffusion profile: a sum of six Gaussians (d'Eon and Luebke 2007), from the narrowest to the widest. Weights of a channel sum to 1.
// All that follows from it, widths, ladder, links, attenuation, is made from these numbers.
#ifndef TEGUMENT_SCATTER_PROFILE_FXH
#include "../../hlsl/scatter/profile.fxh"
#endif
#ifndef TEGUMENT_PASSES_PROFILE_FXH
#define TEGUMENT_PASSES_PROFILE_FXH

float4 gGaussianWeight[6] < string UIName = "Weight (RGB) and variance (mm^2)"; > = {
    { 0.233, 0.455, 0.649, 0.0064 },
    { 0.100, 0.336, 0.344, 0.0484 },
    { 0.118, 0.198, 0.000, 0.187 },
    { 0.113, 0.007, 0.007, 0.567 },
    { 0.358, 0.004, 0.000, 1.99 },
    { 0.078, 0.000, 0.000, 7.41 }
};
// Width of a Gaussian, mm. The table's widths and variances are rounded apart: its own width where the variance is its own.
float gaussianWidth(int i)
{
    float variance = gGaussianWeight[i].w;
    return variance == kTgSkinProfile[i].w ? kTgSkinWidth[i] : sqrt(max(variance, 0.0));
}

#endif
// SPDX-License-Identifier: MIT
