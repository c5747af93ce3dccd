// One direction of one Gaussian of the cascade, exactly as wide as it should be: what the light has been blurred by before is counted, and
// the spacing of the taps is the one for which they, interpolated between texels, have the wanted variance
// (docs/design/modules/Convolution.md). Units: sigma in mm, density = texels per mm, variances and spacings in texels. `axis` = one texel
// along U or V, in uv.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SCATTER_SEAM_FXH
#include "../scatter/seam.fxh"
#endif
#ifndef TEGUMENT_SCATTER_KERNEL_FXH
#include "../scatter/kernel.fxh"
#endif
#ifndef TEGUMENT_SCATTER_GAUSSIAN_FXH
#define TEGUMENT_SCATTER_GAUSSIAN_FXH

// What the cascade still lacks: the increment of the variance, counting what is present.
float tgGaussianIncrement(float sigmaBefore, float sigma, float density, float present)
{
    float before = sigmaBefore * sigmaBefore * density * density;
    float after = sigma * sigma * density * density;
    return max(after, present) - max(before, present);
}

// Spacing s for which the taps, interpolated between texel centres, have the wanted variance. Interpolation replaces x^2 by the chords
// between integers, n^2 + (x - n)(2n + 1) for x = j s in [n, n + 1]: convex and increasing in s. Newton from the uninterpolated solution,
// which lies above, descends to the root; on this piecewise linear function three steps suffice.
float tgGaussianSpacing(float variance)
{
    const float3 tap = float3(1.0, 2.0, 3.0);
    const float3 weight = 2.0 / kTgKernelSum * float3(kTgGaussianKernel[1], kTgGaussianKernel[2], kTgGaussianKernel[3]);
    float s = sqrt(variance / kTgKernelVariance);
    [unroll] for (int i = 0; i < 3; i++)
    {
        float3 n = floor(tap * s);
        float value = dot(weight, n * n + (tap * s - n) * (2.0 * n + 1.0));
        s -= (value - variance) / dot(weight, tap * (2.0 * n + 1.0));
    }
    return max(s, 0.0);
}

// The two texels around a tap, interpolated; invalid ones left out. Returns the weighted sum, and the sum of weights.
float4 tgGaussianTap(TG_SAMPLER2D_PARAM(map), float2 uv, float2 axis, float offset, out float validity)
{
    float left = floor(offset);
    float f = offset - left;
    float4 a = TG_TEX2DLOD(map, float4(uv + left * axis, 0.0, 0.0));
    float4 b = TG_TEX2DLOD(map, float4(uv + (left + 1.0) * axis, 0.0, 0.0));
    float wa = (1.0 - f) * tgSeamValidity(a);
    float wb = f * tgSeamValidity(b);
    validity = wa + wb;
    return wa * a + wb * b;
}

// The weights of the valid texels, normalised. Fills texels outside the charts within its reach.
float4 tgGaussianConvolve(TG_SAMPLER2D_PARAM(map), float2 uv, float2 axis, float spacing)
{
    float4 sum = 0.0;
    float total = 0.0;
    [unroll] for (int j = -3; j <= 3; j++)
    {
        float validity;
        sum += kTgGaussianKernel[abs(j)] * tgGaussianTap(TG_SAMPLER2D_ARG(map), uv, axis, j * spacing, validity);
        total += kTgGaussianKernel[abs(j)] * validity;
    }
    return total > 1e-4 ? sum / max(total, 1e-4) : kTgInvalidTexel;
}

// Texels per mm from a texel of the Stretch map. Outside the charts it holds the mean over the charts, which Stretch.fx leaves there.
float2 tgGaussianDensity(float4 stretch)
{
    return stretch.xy / kTgStretchScale * kTgMapSize;
}

#endif
// SPDX-License-Identifier: MIT
