// Unit vectors, and normals from a tangent-space normal map.
// Conventions: +Y normal maps (glTF); bitangent = tangent.w * cross(normal, tangent.xyz) (MikkTSpace).
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SURFACE_NORMAL_FXH
#define TEGUMENT_SURFACE_NORMAL_FXH

// Squared lengths below this count as zero: normalising them would overflow. The square of 1e-10, far below any vector of a mesh in mm.
static const float kTgTinySquare = 1e-20;

// Zero stays zero, so that nothing downstream becomes NaN.
float3 tgSafeNormalize(float3 v)
{
    return v * rsqrt(max(dot(v, v), kTgTinySquare));
}

// The third component of a unit vector that points out of the surface. Formats of two channels return 0 or 1 in its place, as the interface
// has it.
float tgNormalZ(float2 xy)
{
    return sqrt(saturate(1.0 - dot(xy, xy)));
}

// texel: RGB of the map, 0..1; with TEGUMENT_NORMAL_XY its blue is not read. The basis is not renormalised: MikkTSpace bakes against the
// interpolated vectors as they are.
float3 tgSurfaceNormal(float3 normal, float4 tangent, float3 texel)
{
    float3 bitangent = tangent.w * cross(normal, tangent.xyz);
    float3 t = texel * 2.0 - 1.0;
    if (kTgNormalXY)
        t.z = tgNormalZ(t.xy);
    return tgSafeNormalize(t.x * tangent.xyz + t.y * bitangent + t.z * normal);
}

#endif
// SPDX-License-Identifier: MIT
