// Vectors that address fur maps (seed 004, "mapeamento de ambiente"): the position of the vertex as a direction from the mesh's centre, its
// normal, the sum of both; all without the camera's transformation, so that strands stay where they grow. And the sphere map that a vector
// is looked up in.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SURFACE_NORMAL_FXH
#include "../surface/normal.fxh"
#endif
#ifndef TEGUMENT_FUR_MAPPING_FXH
#define TEGUMENT_FUR_MAPPING_FXH

// Unit vector along v. What has no direction, as the normal of a degenerate face, takes +Z: a look-up needs one.
float3 tgFurDirection(float3 v)
{
    float3 n = tgSafeNormalize(v);
    return dot(n, n) > 0.5 ? n : float3(0.0, 0.0, 1.0);
}

// Where position and normal are opposite, as deep inside a concavity, the sum has no direction: there the normal decides.
// position: from the mesh's centre.
float3 tgFurCombinedVector(float3 position, float3 normal)
{
    float3 sum = tgSafeNormalize(position) + tgSafeNormalize(normal);
    return tgFurDirection(dot(sum, sum) > 1e-8 ? sum : normal);
}

// A helix of one turn around v, of this radius (radians) at the tip: strands curl because each layer looks a little further around.
float3 tgFurCurled(float3 v, float height, float radius)
{
    float3 side = tgSafeNormalize(abs(v.y) < 0.9 ? cross(v, float3(0.0, 1.0, 0.0)) : cross(v, float3(1.0, 0.0, 0.0)));
    float angle = 2.0 * kTgPi * height;
    return tgSafeNormalize(v + radius * height * (cos(angle) * side + sin(angle) * cross(v, side)));
}

// The sphere map of environment mapping: the texel at which a mirror ball seen along -z shows the direction v; v = -z is its whole rim.
float2 tgFurSphereCoordinate(float3 v)
{
    float3 n = tgSafeNormalize(tgSafeNormalize(v) + float3(0.0, 0.0, 1.0));
    return float2(0.5, -0.5) * n.xy + 0.5;
}

#endif
// SPDX-License-Identifier: MIT
