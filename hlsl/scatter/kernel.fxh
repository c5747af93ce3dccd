// The kernel of one direction of one Gaussian of the cascade: 7 taps a spacing apart (d'Eon and Luebke 2007), and what blurs the light
// before it. Units: density = texels per mm, variances and spacings in texels.
#ifndef TEGUMENT_SCATTER_KERNEL_FXH
#define TEGUMENT_SCATTER_KERNEL_FXH

static const float kTgGaussianKernel[4] = { 0.383, 0.242, 0.061, 0.006 };
// A texel is the mean over its square: variance 1/12 along each axis, present before the first convolution.
static const float kTgTexelVariance = 1.0 / 12.0;
// And a shadow's edge has been through the filter of shadow/map.fxh, a box three texels of the light's map wide.
static const float kTgShadowVariance = 9.0 / 12.0;

// Variance (texels^2) of light before the first convolution. shadowTexel: mm of a texel of the light's map on the mesh.
float tgGaussianPresent(float shadowTexel, float density)
{
    float texels = shadowTexel * density;
    return kTgTexelVariance + kTgShadowVariance * texels * texels;
}

// Outside the charts the taps reach 3 texels at least, so that every map is filled as far as a bilinear look-up from inside can see.
float tgGaussianReach(float spacing, float4 stretch)
{
    return stretch.w > 0.5 ? max(spacing, 1.0) : spacing;
}

#endif
// SPDX-License-Identifier: MIT
