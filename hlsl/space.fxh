// From the mesh into the world, and where the light is, from the matrices of a scene; workspace.fxh has the same for effects, whose
// matrices are parameters. Conventions (docs/conventions.md): right-handed, row vectors, mul(v, M). world: of the mesh;
// worldInverseTranspose: of its normals; light: world to the light's clip space, its own pyramid, or parallel rays where the w column is
// (0, 0, 0, 1). Lengths in world units.
#ifndef TEGUMENT_SPACE_FXH
#define TEGUMENT_SPACE_FXH

// Zero stays zero; no vector of a mesh that is scaled by 1e-9 to 1e9 is as short.
float3 tgWorldUnit(float3 v)
{
    return v * rsqrt(max(dot(v, v), 1e-30));
}

float3 tgWorldPosition(float3 position, float4x4 world)
{
    return mul(float4(position, 1.0), world).xyz;
}

// Unit vectors, whatever the world scales by. Right under rotation, mirror and any scale.
float3 tgWorldNormal(float3 normal, float4x4 worldInverseTranspose)
{
    return tgWorldUnit(mul(normal, (float3x3)worldInverseTranspose));
}

// A mirrored world turns the bitangent round: cross(normal, tangent) does not take part in the mirroring.
float4 tgWorldTangent(float4 tangent, float4x4 world)
{
    return float4(tgWorldUnit(mul(tangent.xyz, (float3x3)world)), determinant((float3x3)world) < 0.0 ? -tangent.w : tangent.w);
}

// A vector of the world along the mesh's own axes, with its length in the world: right under rotation, mirror and scales along the mesh's
// axes.
float3 tgMeshAxes(float3 v, float4x4 world)
{
    return float3(dot(v, tgWorldUnit(world[0].xyz)), dot(v, tgWorldUnit(world[1].xyz)), dot(v, tgWorldUnit(world[2].xyz)));
}

// Parallel light: w is the same everywhere.
bool tgLightParallel(float4x4 light)
{
    float3 w = mul(light, float4(0.0, 0.0, 0.0, 1.0)).xyz;
    return dot(w, w) <= 0.0;
}

// Where parallel light goes: its z rises along its rays.
float3 tgLightRays(float4x4 light)
{
    return tgWorldUnit(mul(light, float4(0.0, 0.0, 1.0, 0.0)).xyz);
}

// From a point of the world to the light; linear over a triangle. To its position; of parallel light along its rays, to the plane of its
// position.
float3 tgLightVector(float3 world, float3 lightPosition, float4x4 light)
{
    float3 toLight = lightPosition - world;
    return tgLightParallel(light) ? dot(toLight, tgLightRays(light)) * tgLightRays(light) : toLight;
}

// Unit vector from a point of the world to the light, also where the point lies before the plane of parallel light.
float3 tgLightDirection(float3 world, float3 lightPosition, float4x4 light)
{
    return tgLightParallel(light) ? -tgLightRays(light) : tgWorldUnit(lightPosition - world);
}

// The light's right and up, unit vectors.
float3 tgLightRight(float4x4 light)
{
    return tgWorldUnit(mul(light, float4(1.0, 0.0, 0.0, 0.0)).xyz);
}

float3 tgLightUp(float4x4 light)
{
    return tgWorldUnit(mul(light, float4(0.0, 1.0, 0.0, 0.0)).xyz);
}

// mm across the light's view, half of its width, for each unit of w: what tgShadowFootprint takes. unitMm: mm in one world unit.
float tgLightSpread(float4x4 light, float unitMm)
{
    return unitMm / max(length(mul(light, float4(1.0, 0.0, 0.0, 0.0)).xyz), 1e-30);
}

#endif
// SPDX-License-Identifier: MIT
