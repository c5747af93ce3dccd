// The diffusion profile of skin, a sum of six Gaussians (d'Eon and Luebke 2007): weights of each channel, which sum to 1, and variance,
// mm^2; and their widths, mm. Effects have the same numbers as parameters (effects/passes/profile.fxh).
#ifndef TEGUMENT_SCATTER_PROFILE_FXH
#define TEGUMENT_SCATTER_PROFILE_FXH

static const float4 kTgSkinProfile[6] = {
    float4(0.233, 0.455, 0.649, 0.0064), float4(0.100, 0.336, 0.344, 0.0484), float4(0.118, 0.198, 0.000, 0.187),
    float4(0.113, 0.007, 0.007, 0.567),  float4(0.358, 0.004, 0.000, 1.99),   float4(0.078, 0.000, 0.000, 7.41)
};
static const float kTgSkinWidth[6] = { 0.080, 0.220, 0.432, 0.753, 1.411, 2.722 };

#endif
// SPDX-License-Identifier: MIT
