// scatter/gaussian.fxh as printed (seed equations 25, 26, 37 and Table 7; d'Eon and Luebke 2007): taps sqrt(variance) apart, repaired
// outside the charts.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PRINTED_SEED_FXH
#include "../printed/seed.fxh"
#endif
#ifndef TEGUMENT_PRINTED_DEON2007_FXH
#include "../printed/deon2007.fxh"
#endif
#ifndef TEGUMENT_SCATTER_SEAM_FXH
#include "../scatter/seam.fxh"
#endif
#ifndef TEGUMENT_SCATTER_KERNEL_FXH
#include "../scatter/kernel.fxh"
#endif
#ifndef TEGUMENT_PRINTED_GAUSSIAN_FXH
#define TEGUMENT_PRINTED_GAUSSIAN_FXH

// Seed: each pass takes its own sigma literally. Paper: the increment of the variance.
float tgGaussianIncrement(float sigmaBefore, float sigma, float density, float present)
{
    float before = sigmaBefore * sigmaBefore * density * density;
    float after = sigma * sigma * density * density;
    return kTgConvolveIncrement ? max(after - before, 0.0) : after;
}

float tgGaussianSpacing(float variance)
{
    return sqrt(variance);
}

// The two texels around a tap as one: the valid one where the other is not, invalid where neither is.
float4 tgGaussianTexel(TG_SAMPLER2D_PARAM(map), float2 uv, float2 axis, float offset)
{
    float left = floor(offset);
    float f = offset - left;
    float4 a = TG_TEX2DLOD(map, float4(uv + left * axis, 0.0, 0.0));
    float4 b = TG_TEX2DLOD(map, float4(uv + (left + 1.0) * axis, 0.0, 0.0));
    float second = f > 0.0 ? tgSeamValidity(b) : 0.0;
    return lerp(a, b, tgSeamValidity(a) * second > 0.0 ? f : second);
}

// Table 7: an invalid centre becomes the first valid neighbour in the order -3..3, then invalid taps take the centre's value.
float4 tgGaussianConvolve(TG_SAMPLER2D_PARAM(map), float2 uv, float2 axis, float spacing)
{
    float4 tap[7];
    [unroll] for (int j = 0; j < 7; j++)
        tap[j] = tgGaussianTexel(TG_SAMPLER2D_ARG(map), uv, axis, (j - 3) * spacing);
    float4 centre = kTgInvalidTexel;
    [unroll] for (int k = 6; k >= 0; k--)
        centre = tgSeamValidity(tap[k]) > 0.0 ? tap[k] : centre;
    centre = tgSeamValidity(tap[3]) > 0.0 ? tap[3] : centre;
    float4 sum = 0.0;
    [unroll] for (int i = 0; i < 7; i++)
        sum += kTgGaussianKernel[abs(i - 3)] * (tgSeamValidity(tap[i]) > 0.0 ? tap[i] : centre);
    // The printed sum of 1.001 must not lift the alpha of a valid texel towards 1, nor that of an invalid one off it.
    sum.w = tgSeamValidity(centre) > 0.0 ? min(sum.w, kTgLargestAlpha) : 1.0;
    return sum;
}

// Outside the charts (alpha 1) the seed ignores the stretch, a factor of 1; the paper uses the mean over the charts, which Stretch.fx
// leaves there.
float2 tgGaussianDensity(float4 stretch)
{
    float2 encoded = kTgIgnoreStretchOutside && stretch.w > 0.5 ? float2(1.0, 1.0) : stretch.xy;
    return encoded / kTgStretchScale * kTgMapSize;
}

#endif
// SPDX-License-Identifier: MIT
