// Shadow map: depth of the surface nearest to the light (seed equation 7). Lit where depth - tolerance <= texel. The functions read x only, so a
// translucent shadow map serves too.
// Depth: setting seed z/w; else the distance to the light in mm, so that along one ray the difference of two depths is a length.
#ifndef TEGUMENT_SHADOW_MAP_FXH
#define TEGUMENT_SHADOW_MAP_FXH

// Smallest N.L that slopes are computed with. Below it the receiving plane is seen edge-on: its depth would change without limit within a texel.
static const float kSmallestSlopeCosine = 0.15;
// Share of a texel's slope that remains as tolerance, for a curved surface is not the plane it is taken for.
static const float kSlopeTolerance = 1.0;
// N.L of the mesh at which its own horizon has passed.
static const float kHorizon = 0.05;
// Depth of what is not there, mm or z/w.
static const float kNoSurface = 1e9;

float2 shadowCoordinate(float4 lightClip)
{
    return lightClip.xy / max(lightClip.w, 1e-6) * float2(0.5, -0.5) + 0.5;
}

float shadowDepth(float4 lightClip, float3 fromLight)
{
    return kDepthInMillimetres ? length(fromLight) : lightClip.z / max(lightClip.w, 1e-6);
}

// mm across a texel at this distance from the light (depth, mm); fov = angle of its pyramid, radians.
float shadowFootprint(float depth, float fov)
{
    return 2.0 * depth * tan(0.5 * fov) / kMapSize;
}

// Change of depth (mm) from texel to texel along u and v on the plane through the receiver; the inverse of tsmNormal. axisX, axisY: the light's right and up.
float2 shadowSlope(float3 normal, float3 axisX, float3 axisY, float3 toLight, float footprint)
{
    float cosine = dot(normal, toLight);
    float2 slope = float2(dot(normal, axisX), -dot(normal, axisY)) * footprint / max(cosine, kSmallestSlopeCosine);
    return kFilterShadow && cosine > 0.0 ? slope : float2(0.0, 0.0);
}

// A surface that turns away from the light is shadowed by itself, whatever its normal map says and the map's texels can resolve.
float shadowHorizon(float cosine)
{
    return kFilterShadow ? saturate(cosine / kHorizon) : 1.0;
}

// Maps are cleared to 0, because Direct3D 9 clears to 0..1 in 8 bits: there is no surface, and nothing lies in front of anything.
float4 shadowStored(float4 depth)
{
    return float4(depth.x > 0.0 ? depth.x : kNoSurface, depth.y > 0.0 ? depth.y : kNoSurface, depth.z > 0.0 ? depth.z : kNoSurface,
                  depth.w > 0.0 ? depth.w : kNoSurface);
}

// Lit where the nearest surface is not before this depth.
float shadowLit(SAMPLER2D_PARAM(map), float2 coordinate, float depth)
{
    return depth <= shadowStored(tex2Dlod(map, float4(coordinate, 0.0, 0.0))).x ? 1.0 : 0.0;
}

// Box three texels wide over bilinear comparisons: 4 x 4 taps weighted (1 - f, 1, 1, f) in both directions, each compared with the receiver's plane there.
float shadowFiltered(SAMPLER2D_PARAM(map), float2 coordinate, float depth, float2 slope)
{
    float2 position = coordinate * kMapSize - 0.5;
    float2 f = frac(position);
    float2 corner = (position - f - 0.5) / kMapSize;
    float4 rowWeight = float4(1.0 - f.y, 1.0, 1.0, f.y);
    float4 plane = depth + slope.x * (float4(-1.0, 0.0, 1.0, 2.0) - f.x);
    float sum = 0.0;
    [unroll] for (int j = 0; j < 4; j++)
    {
        float4 row;
        [unroll] for (int i = 0; i < 4; i++)
            row[i] = tex2Dlod(map, float4(corner + float2(i, j) / kMapSize, 0.0, 0.0)).x;
        sum += rowWeight[j] * dot(step(plane + slope.y * (j - 1.0 - f.y), shadowStored(row)), float4(1.0 - f.x, 1.0, 1.0, f.x));
    }
    return sum / 9.0;
}

// depth, tolerance: mm, or z/w. slope: from shadowSlope.
float shadowTest(SAMPLER2D_PARAM(map), float2 coordinate, float depth, float tolerance, float2 slope)
{
    if (kFilterShadow)
        return shadowFiltered(SAMPLER2D_ARG(map), coordinate, depth - tolerance - kSlopeTolerance * (abs(slope.x) + abs(slope.y)), slope);
    return shadowLit(SAMPLER2D_ARG(map), coordinate, depth - tolerance);
}

#endif
