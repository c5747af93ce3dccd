// Translucent shadow map, modified: depth and texture coordinates of the surface nearest to the light (d'Eon and Luebke 2007, "Modified translucent
// shadow maps"; after Dachsbacher and Stamminger 2003). Texel = (depth, u, v, 1 where there is a surface).
// Depth: setting seed z/w; else the distance to the light in mm, so that along one ray the difference of two depths is the length inside the body.
#ifndef TEGUMENT_SHADOW_TSM_FXH
#define TEGUMENT_SHADOW_TSM_FXH

// Largest slope of the bias, tan(87 degrees): beyond it N.L is below 0.05 and the light with it.
static const float kSteepestSlope = 20.0;
// The filter reaches 2 texels from the receiver, and half a texel is lost to sampling.
static const float kFilterReach = 2.5;

float2 tsmCoordinate(float4 lightClip)
{
    return lightClip.xy / max(lightClip.w, 1e-6) * float2(0.5, -0.5) + 0.5;
}

float tsmDepth(float4 lightClip, float3 fromLight)
{
    return kDepthInMillimetres ? length(fromLight) : lightClip.z / max(lightClip.w, 1e-6);
}

// Tolerance of the depth comparison. Corrected: `tolerance` mm plus what the surface's slope towards the light adds within the filter's reach.
// cosine = N.L of the unperturbed normal; fov = angle of the light's pyramid, radians; distance to the light in mm.
float tsmTolerance(float tolerance, float cosine, float distance, float fov)
{
    float footprint = 2.0 * distance * tan(0.5 * fov) / kMapSize;
    float slope = min(sqrt(max(1.0 - cosine * cosine, 0.0)) / max(cosine, 1e-3), kSteepestSlope);
    return kFilterShadow ? tolerance + kFilterReach * footprint * slope : tolerance;
}

float tsmLit(float4 texel, float depth, float tolerance)
{
    return texel.w < 0.5 || depth - tolerance <= texel.x ? 1.0 : 0.0;
}

// Box three texels wide over bilinear comparisons: 16 taps weighted (1 - f, 1, 1, f) in both directions.
float tsmFilteredShadow(SAMPLER2D_PARAM(tsm), float2 coordinate, float depth, float tolerance)
{
    float2 position = coordinate * kMapSize - 0.5;
    float2 f = frac(position);
    float2 corner = (position - f - 0.5) / kMapSize;
    float4 wu = float4(1.0 - f.x, 1.0, 1.0, f.x);
    float4 wv = float4(1.0 - f.y, 1.0, 1.0, f.y);
    float sum = 0.0;
    [unroll] for (int j = 0; j < 4; j++)
        [unroll] for (int i = 0; i < 4; i++)
            sum += wu[i] * wv[j] * tsmLit(tex2Dlod(tsm, float4(corner + float2(i, j) / kMapSize, 0.0, 0.0)), depth, tolerance);
    return sum / 9.0;
}

float tsmShadow(SAMPLER2D_PARAM(tsm), float2 coordinate, float depth, float tolerance)
{
    if (kFilterShadow)
        return tsmFilteredShadow(SAMPLER2D_ARG(tsm), coordinate, depth, tolerance);
    return tsmLit(tex2Dlod(tsm, float4(coordinate, 0.0, 0.0)), depth, tolerance);
}

#endif
