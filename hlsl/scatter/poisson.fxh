// One blur of Gosselin's technique (Gosselin, Sander and Mitchell 2004): 13 taps, the texel itself and twelve of a Poisson disc (seed 5.3, equations 36
// and 40, Table 7). The alpha of the map is the kernel size, at most kLargestAlpha; every blur leaves it as it is.
// Units: density = texels per mm; radii in uv, one along each axis.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SCATTER_SEAM_FXH
#include "../scatter/seam.fxh"
#endif
#ifndef TEGUMENT_SCATTER_POISSON_FXH
#define TEGUMENT_SCATTER_POISSON_FXH

static const float2 kPoissonDisc[12] = {
    float2(-0.326212, -0.405810), float2(-0.840144, -0.073580), float2(-0.695914, 0.457137), float2(-0.203345, 0.620716),
    float2(0.962340, -0.194983), float2(0.473434, -0.480026), float2(0.519456, 0.767022), float2(0.185461, -0.893124),
    float2(0.507431, 0.064425), float2(0.896420, 0.412458), float2(-0.321940, -0.932615), float2(-0.791559, -0.597710)
};
// Mean of the printed points. Left in, each blur shifts the light by a tenth of the radius.
static const float2 kPoissonMean = float2(0.030452, -0.104674);
// Longest of the points, mean subtracted or not.
static const float kPoissonLongest = 1.01;
// Outside the charts the taps reach this far at least (texels), so that what Final looks up between texels is filled.
static const float kPoissonFill = 3.0;

// rotation: cosine and sine of the angle by which the disc is turned.
float2 poissonPoint(int i, float2 rotation)
{
    float2 p = kPoissonCentred ? kPoissonDisc[i] - kPoissonMean : kPoissonDisc[i];
    return float2(p.x * rotation.x - p.y * rotation.y, p.x * rotation.y + p.y * rotation.x);
}

// Equation 40 as printed, size * kernel * (1 / width + 1 / height), where size is half the radius in texels. Corrected: size in mm on the surface.
float2 poissonRadius(float size, float4 centre, float2 density)
{
    float kernel = min(centre.w, kLargestAlpha);
    float2 texels = size * kernel * (kPoissonStretched ? density : float2(2.0, 2.0));
    return (kPoissonStretched && seamValidity(centre) < 1.0 ? max(texels, kPoissonFill) : texels) / kMapSize;
}

// Corrected: the mean of the valid taps. A texel outside the charts takes their mean kernel size too.
float4 poissonOverValid(SAMPLER2D_PARAM(map), float2 uv, float4 centre, float2 radius, float2 rotation)
{
    float inside = seamValidity(centre);
    float4 sum = inside * centre;
    float total = inside;
    [unroll] for (int i = 0; i < 12; i++)
    {
        float4 tap = tex2Dlod(map, float4(uv + poissonPoint(i, rotation) * radius, 0.0, 0.0));
        float validity = seamValidity(tap);
        sum += validity * tap;
        total += validity;
    }
    float4 mean = sum / max(total, 1.0);
    return total > 0.0 ? float4(mean.rgb, inside > 0.0 ? centre.w : mean.w) : kInvalidTexel;
}

// Table 7: an invalid centre becomes the first valid neighbour in the order of the disc; then invalid taps take the centre's value (equation 36).
float4 poissonRepaired(SAMPLER2D_PARAM(map), float2 uv, float4 centre, float2 radius, float2 rotation)
{
    float4 tap[12];
    [unroll] for (int i = 0; i < 12; i++)
        tap[i] = tex2Dlod(map, float4(uv + poissonPoint(i, rotation) * radius, 0.0, 0.0));
    float4 first = centre;
    [unroll] for (int k = 11; k >= 0; k--)
        first = seamValidity(tap[k]) > 0.0 ? tap[k] : first;
    first = seamValidity(centre) > 0.0 ? centre : first;
    float3 sum = first.rgb;
    [unroll] for (int j = 0; j < 12; j++)
        sum += seamValidity(tap[j]) > 0.0 ? tap[j].rgb : first.rgb;
    return float4(sum / 13.0, first.w);
}

float4 poissonBlur(SAMPLER2D_PARAM(map), float2 uv, float4 centre, float2 radius, float2 rotation)
{
    if (kPoissonStretched)
        return poissonOverValid(SAMPLER2D_ARG(map), uv, centre, radius, rotation);
    return poissonRepaired(SAMPLER2D_ARG(map), uv, centre, radius, rotation);
}

#endif
