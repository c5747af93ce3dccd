// What the scene gives to every effect: transforms, light, camera, target; the vertex streams; clear values of the scripts; space.fxh with
// these matrices. Conventions (docs/conventions.md): right-handed, row vectors; world coordinates times gUnitMm are mm; light colour is
// E/pi; one light with its own pyramid, or with parallel rays where the w column of its matrix is (0, 0, 0, 1). What is shown, clipped or
// aimed stays in world units; every length that is compared with one in mm comes through tgMillimetres().
#ifndef TEGUMENT_SPACE_FXH
#include "../hlsl/space.fxh"
#endif
#ifndef TEGUMENT_WORKSPACE_FXH
#define TEGUMENT_WORKSPACE_FXH

float4x4 gWorld : WORLD < string UIWidget = "None"; >;
float4x4 gWorldInverseTranspose : WORLDINVERSETRANSPOSE < string UIWidget = "None"; >;
float4x4 gViewProjection : VIEWPROJECTION < string UIWidget = "None"; >;
float4x4 gLightViewProjection : VIEWPROJECTION < string Object = "PointLight0"; string UIWidget = "None"; >;
float3 gLightPosition : POSITION < string Object = "PointLight0"; string Space = "World"; string UIName = "Light position";
    string UIHelp = "world units; of parallel light a point on its near plane"; >;
float gLightNear : NEARCLIP < string Object = "PointLight0"; string UIWidget = "None"; >;
float3 gLightColor : DIFFUSE < string Object = "PointLight0"; string UIName = "Light colour"; string UIWidget = "Color";
    string UIHelp = "irradiance / pi, linear"; >;
float gLightFar : FARCLIP < string Object = "PointLight0"; string UIWidget = "None"; >;
float3 gCameraPosition : CAMERAPOSITION < string UIWidget = "None"; >;
float gUnitMm : UNITMM < string UIWidget = "None"; string UIHelp = "mm in one unit of the world"; > = 1.0;

float4 gClearEmpty < string UIWidget = "None"; > = { 0.0, 0.0, 0.0, 0.0 };
float4 gClearInvalid < string UIWidget = "None"; > = { 0.0, 0.0, 0.0, 1.0 };
float2 gViewportSize : VIEWPORTPIXELSIZE < string UIWidget = "None"; >;
float gClearNear < string UIWidget = "None"; > = 0.0;
float gClearFar < string UIWidget = "None"; > = 1.0;

struct TgMeshInput
{
    float3 position : POSITION;
    float3 normal : NORMAL;
    float4 tangent : TANGENT;
    float2 uv : TEXCOORD0;
};

// At a point: unit vector towards the light, and its colour on a surface that faces it, E/pi.
struct TgLight
{
    float3 toLight;
    float3 color;
};

struct TgQuadInput
{
    float3 position : POSITION;
    float2 uv : TEXCOORD0;
};

// Lengths in world units.
float3 tgWorldPosition(float3 position)
{
    return tgWorldPosition(position, gWorld);
}

// World units into mm.
float tgMillimetres(float length)
{
    return length * gUnitMm;
}

float3 tgMillimetres(float3 v)
{
    return v * gUnitMm;
}

float3 tgWorldNormal(float3 normal)
{
    return tgWorldNormal(normal, gWorldInverseTranspose);
}

float4 tgWorldTangent(float4 tangent)
{
    return tgWorldTangent(tangent, gWorld);
}

float3 tgMeshAxes(float3 v)
{
    return tgMeshAxes(v, gWorld);
}

bool tgLightParallel()
{
    return tgLightParallel(gLightViewProjection);
}

float3 tgLightRays()
{
    return tgLightRays(gLightViewProjection);
}

float3 tgLightVector(float3 world)
{
    return tgLightVector(world, gLightPosition, gLightViewProjection);
}

float3 tgLightDirection(float3 world)
{
    return tgLightDirection(world, gLightPosition, gLightViewProjection);
}

float3 tgLightRight()
{
    return tgLightRight(gLightViewProjection);
}

float3 tgLightUp()
{
    return tgLightUp(gLightViewProjection);
}

float tgLightSpread()
{
    return tgLightSpread(gLightViewProjection, tgMillimetres(1.0));
}

#endif
// SPDX-License-Identifier: MIT
