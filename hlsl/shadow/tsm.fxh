// Translucent shadow map, modified: depth and texture coordinates of the surface nearest to the light (d'Eon and Luebke 2007, "Modified translucent
// shadow maps"; after Dachsbacher and Stamminger 2003). Texel = (depth, u, v, 1); (1e9, 0, 0, 0) where there is no surface.
// Depth: setting seed z/w; else the distance to the light in mm, so that along one ray the difference of two depths is the length inside the body.
#ifndef TEGUMENT_SHADOW_TSM_FXH
#define TEGUMENT_SHADOW_TSM_FXH

// Smallest N.L that slopes are computed with. Below it the receiving plane is seen edge-on: its depth would change without limit within a texel.
static const float kSmallestSlopeCosine = 0.15;
// Share of a texel's slope that remains as tolerance, for a curved surface is not the plane it is taken for.
static const float kSlopeTolerance = 1.0;
// N.L of the mesh at which its own horizon has passed.
static const float kHorizon = 0.05;
// Texels whose texture coordinates differ by less are one piece of surface: 3 % of the map, about 9 mm of a head.
static const float kOnePiece = 0.03;

float2 tsmCoordinate(float4 lightClip)
{
    return lightClip.xy / max(lightClip.w, 1e-6) * float2(0.5, -0.5) + 0.5;
}

float tsmDepth(float4 lightClip, float3 fromLight)
{
    return kDepthInMillimetres ? length(fromLight) : lightClip.z / max(lightClip.w, 1e-6);
}

// mm across a texel at this distance from the light (depth, mm); fov = angle of its pyramid, radians.
float tsmFootprint(float depth, float fov)
{
    return 2.0 * depth * tan(0.5 * fov) / kMapSize;
}

// Change of depth (mm) from texel to texel along u and v on the plane through the receiver; the inverse of tsmNormal. axisX, axisY: the light's right and up.
float2 tsmSlope(float3 normal, float3 axisX, float3 axisY, float3 toLight, float footprint)
{
    float cosine = dot(normal, toLight);
    float2 slope = float2(dot(normal, axisX), -dot(normal, axisY)) * footprint / max(cosine, kSmallestSlopeCosine);
    return kFilterShadow && cosine > 0.0 ? slope : float2(0.0, 0.0);
}

// Normal of the lit surface, from the slope of its depths. axisX, axisY: the light's right and up; footprint: mm of a texel; range: mm of a unit depth.
float3 tsmNormal(SAMPLER2D_PARAM(tsm), float2 coordinate, float3 axisX, float3 axisY, float3 toLight, float footprint, float range)
{
    float2 texel = float2(1.0, 0.0) / kMapSize;
    float dx = tex2Dlod(tsm, float4(coordinate + texel.xy, 0.0, 0.0)).x - tex2Dlod(tsm, float4(coordinate - texel.xy, 0.0, 0.0)).x;
    float dy = tex2Dlod(tsm, float4(coordinate - texel.yx, 0.0, 0.0)).x - tex2Dlod(tsm, float4(coordinate + texel.yx, 0.0, 0.0)).x;
    return safeNormalize(2.0 * footprint * toLight + range * (dx * axisX + dy * axisY));
}

// Point where the light entered: interpolated where the four texels lie on one piece of the surface, else the nearest texel. Seen at a grazing angle
// neighbouring texels lie far apart on the surface; read singly they would print their steps on the side away from the light.
float4 tsmEntry(SAMPLER2D_PARAM(tsm), float2 coordinate)
{
    float2 position = coordinate * kMapSize - 0.5;
    float2 f = frac(position);
    float2 corner = (position - f + 0.5) / kMapSize;
    float4 a = tex2Dlod(tsm, float4(corner, 0.0, 0.0));
    float4 b = tex2Dlod(tsm, float4(corner + float2(1.0, 0.0) / kMapSize, 0.0, 0.0));
    float4 c = tex2Dlod(tsm, float4(corner + float2(0.0, 1.0) / kMapSize, 0.0, 0.0));
    float4 d = tex2Dlod(tsm, float4(corner + float2(1.0, 1.0) / kMapSize, 0.0, 0.0));
    float3 spread = max(max(a, b), max(c, d)).yzw - min(min(a, b), min(c, d)).yzw;
    float4 nearest = lerp(lerp(a, b, step(0.5, f.x)), lerp(c, d, step(0.5, f.x)), step(0.5, f.y));
    return max(spread.x, max(spread.y, spread.z)) < kOnePiece ? lerp(lerp(a, b, f.x), lerp(c, d, f.x), f.y) : nearest;
}

// A surface that turns away from the light is shadowed by itself, whatever its normal map says and the map's texels can resolve.
float tsmHorizon(float cosine)
{
    return kFilterShadow ? saturate(cosine / kHorizon) : 1.0;
}

// Lit where the nearest surface is not before this depth. Texels without surface hold a depth beyond any (the clear value of the script).
float tsmLit(SAMPLER2D_PARAM(tsm), float2 coordinate, float depth)
{
    return depth <= tex2Dlod(tsm, float4(coordinate, 0.0, 0.0)).x ? 1.0 : 0.0;
}

// Box three texels wide over bilinear comparisons: 4 x 4 taps weighted (1 - f, 1, 1, f) in both directions, each compared with the receiver's plane there.
float tsmFilteredShadow(SAMPLER2D_PARAM(tsm), float2 coordinate, float depth, float2 slope)
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
            row[i] = tex2Dlod(tsm, float4(corner + float2(i, j) / kMapSize, 0.0, 0.0)).x;
        sum += rowWeight[j] * dot(step(plane + slope.y * (j - 1.0 - f.y), row), float4(1.0 - f.x, 1.0, 1.0, f.x));
    }
    return sum / 9.0;
}

// depth, tolerance: mm, or z/w. slope: from tsmSlope.
float tsmShadow(SAMPLER2D_PARAM(tsm), float2 coordinate, float depth, float tolerance, float2 slope)
{
    if (kFilterShadow)
        return tsmFilteredShadow(SAMPLER2D_ARG(tsm), coordinate, depth - tolerance - kSlopeTolerance * (abs(slope.x) + abs(slope.y)), slope);
    return tsmLit(SAMPLER2D_ARG(tsm), coordinate, depth - tolerance);
}

#endif
