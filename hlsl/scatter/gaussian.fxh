// One direction of one Gaussian of the cascade: 7 taps a spacing apart (d'Eon and Luebke 2007; seed equations 25, 26, 37 and Table 7).
// Units: sigma in mm, density = texels per mm, variances and spacings in texels. `axis` = one texel along U or V, in uv.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SCATTER_SEAM_FXH
#include "../scatter/seam.fxh"
#endif
#ifndef TEGUMENT_SCATTER_GAUSSIAN_FXH
#define TEGUMENT_SCATTER_GAUSSIAN_FXH

static const float kGaussianKernel[4] = { 0.383, 0.242, 0.061, 0.006 };
// A texel is the mean over its square: variance 1/12 along each axis, present before the first convolution.
static const float kTexelVariance = 1.0 / 12.0;
// And a shadow's edge has been through the filter of shadow/map.fxh, a box three texels of the light's map wide.
static const float kShadowVariance = 9.0 / 12.0;

// Variance (texels^2) of light before the first convolution. shadowTexel: mm of a texel of the light's map on the mesh.
float gaussianPresent(float shadowTexel, float density)
{
    float texels = shadowTexel * density;
    return kTexelVariance + kShadowVariance * texels * texels;
}

// What the cascade still lacks. Seed: each pass takes its own sigma literally. Paper: the increment of the variance. Corrected: the same,
// counting what is present.
float gaussianIncrement(float sigmaBefore, float sigma, float density, float present)
{
    float before = sigmaBefore * sigmaBefore * density * density;
    float after = sigma * sigma * density * density;
    if (kConvolveExactly)
        return max(after, present) - max(before, present);
    return kConvolveIncrement ? max(after - before, 0.0) : after;
}

// Spacing s for which the taps, interpolated between texel centres, have the wanted variance. Interpolation replaces x^2 by the chords between
// integers, n^2 + (x - n)(2n + 1) for x = j s in [n, n + 1]: convex and increasing in s. Newton from the uninterpolated solution, which lies
// above, descends to the root; on this piecewise linear function three steps suffice.
float gaussianExactSpacing(float variance)
{
    const float3 tap = float3(1.0, 2.0, 3.0);
    const float3 weight = 2.0 / kKernelSum * float3(kGaussianKernel[1], kGaussianKernel[2], kGaussianKernel[3]);
    float s = sqrt(variance / kKernelVariance);
    [unroll] for (int i = 0; i < 3; i++)
    {
        float3 n = floor(tap * s);
        float value = dot(weight, n * n + (tap * s - n) * (2.0 * n + 1.0));
        s -= (value - variance) / dot(weight, tap * (2.0 * n + 1.0));
    }
    return max(s, 0.0);
}

float gaussianSpacing(float variance)
{
    return kConvolveExactly ? gaussianExactSpacing(variance) : sqrt(variance);
}

// The two texels around a tap, interpolated; invalid ones left out. Returns the weighted sum, and the sum of weights.
float4 gaussianTap(SAMPLER2D_PARAM(map), float2 uv, float2 axis, float offset, out float validity)
{
    float left = floor(offset);
    float f = offset - left;
    float4 a = tex2Dlod(map, float4(uv + left * axis, 0.0, 0.0));
    float4 b = tex2Dlod(map, float4(uv + (left + 1.0) * axis, 0.0, 0.0));
    float wa = (1.0 - f) * seamValidity(a);
    float wb = f * seamValidity(b);
    validity = wa + wb;
    return wa * a + wb * b;
}

// Corrected: the weights of the valid texels, normalised. Fills texels outside the charts within its reach.
float4 gaussianOverValid(SAMPLER2D_PARAM(map), float2 uv, float2 axis, float spacing)
{
    float4 sum = 0.0;
    float total = 0.0;
    [unroll] for (int j = -3; j <= 3; j++)
    {
        float validity;
        sum += kGaussianKernel[abs(j)] * gaussianTap(SAMPLER2D_ARG(map), uv, axis, j * spacing, validity);
        total += kGaussianKernel[abs(j)] * validity;
    }
    return total > 1e-4 ? sum / max(total, 1e-4) : kInvalidTexel;
}

// The same tap as one texel: the valid one where the other is not, invalid where neither is.
float4 gaussianTexel(SAMPLER2D_PARAM(map), float2 uv, float2 axis, float offset)
{
    float left = floor(offset);
    float f = offset - left;
    float4 a = tex2Dlod(map, float4(uv + left * axis, 0.0, 0.0));
    float4 b = tex2Dlod(map, float4(uv + (left + 1.0) * axis, 0.0, 0.0));
    float second = f > 0.0 ? seamValidity(b) : 0.0;
    return lerp(a, b, seamValidity(a) * second > 0.0 ? f : second);
}

// Table 7: an invalid centre becomes the first valid neighbour in the order -3..3, then invalid taps take the centre's value.
float4 gaussianRepaired(SAMPLER2D_PARAM(map), float2 uv, float2 axis, float spacing)
{
    float4 tap[7];
    [unroll] for (int j = 0; j < 7; j++)
        tap[j] = gaussianTexel(SAMPLER2D_ARG(map), uv, axis, (j - 3) * spacing);
    float4 centre = kInvalidTexel;
    [unroll] for (int k = 6; k >= 0; k--)
        centre = seamValidity(tap[k]) > 0.0 ? tap[k] : centre;
    centre = seamValidity(tap[3]) > 0.0 ? tap[3] : centre;
    float4 sum = 0.0;
    [unroll] for (int i = 0; i < 7; i++)
        sum += kGaussianKernel[abs(i - 3)] * (seamValidity(tap[i]) > 0.0 ? tap[i] : centre);
    // The printed sum of 1.001 must not lift the alpha of a valid texel towards 1, nor that of an invalid one off it.
    sum.w = seamValidity(centre) > 0.0 ? min(sum.w, kLargestAlpha) : 1.0;
    return sum;
}

float4 gaussianConvolve(SAMPLER2D_PARAM(map), float2 uv, float2 axis, float spacing)
{
    if (kConvolveExactly)
        return gaussianOverValid(SAMPLER2D_ARG(map), uv, axis, spacing);
    return gaussianRepaired(SAMPLER2D_ARG(map), uv, axis, spacing);
}

// Texels per mm from a texel of the Stretch map. Outside the charts (alpha 1) the seed ignores the stretch, a factor of 1; the others use the mean
// over the charts, which Stretch.fx leaves there.
float2 gaussianDensity(float4 stretch)
{
    float2 encoded = kSeed && stretch.w > 0.5 ? float2(1.0, 1.0) : stretch.xy;
    return encoded / kStretchScale * kMapSize;
}

// Outside the charts the taps reach 3 texels at least, so that every map is filled as far as a bilinear look-up from inside can see.
float gaussianReach(float spacing, float4 stretch)
{
    return stretch.w > 0.5 ? max(spacing, 1.0) : spacing;
}

#endif
