// What the scene gives to every effect: transforms, light, camera, target; the vertex streams; clear values of the scripts.
// Conventions (docs/conventions.md): right-handed, row vectors; world coordinates times gUnitMm are mm; light colour is E/pi; one light with its own
// pyramid, or with parallel rays where the w column of its matrix is (0, 0, 0, 1). What is shown, clipped or aimed stays in world units; every length
// that is compared with one in mm comes through millimetres().
#ifndef TEGUMENT_WORKSPACE_FXH
#define TEGUMENT_WORKSPACE_FXH

float4x4 gWorld : WORLD < string UIWidget = "None"; >;
float4x4 gWorldInverseTranspose : WORLDINVERSETRANSPOSE < string UIWidget = "None"; >;
float4x4 gViewProjection : VIEWPROJECTION < string UIWidget = "None"; >;
float4x4 gLightViewProjection : VIEWPROJECTION < string Object = "PointLight0"; string UIWidget = "None"; >;
float3 gLightPosition : POSITION < string Object = "PointLight0"; string Space = "World"; string UIName = "Light position"; string UIHelp = "world units; of parallel light a point on its near plane"; >;
float gLightNear : NEARCLIP < string Object = "PointLight0"; string UIWidget = "None"; >;
float3 gLightColor : DIFFUSE < string Object = "PointLight0"; string UIName = "Light colour"; string UIWidget = "Color"; string UIHelp = "irradiance / pi, linear"; >;
float gLightFar : FARCLIP < string Object = "PointLight0"; string UIWidget = "None"; >;
float3 gCameraPosition : CAMERAPOSITION < string UIWidget = "None"; >;
float gUnitMm : UNITMM < string UIWidget = "None"; string UIHelp = "mm in one unit of the world"; > = 1.0;

float4 gClearEmpty < string UIWidget = "None"; > = { 0.0, 0.0, 0.0, 0.0 };
float4 gClearInvalid < string UIWidget = "None"; > = { 0.0, 0.0, 0.0, 1.0 };
float2 gViewportSize : VIEWPORTPIXELSIZE < string UIWidget = "None"; >;
float gClearNear < string UIWidget = "None"; > = 0.0;
float gClearFar < string UIWidget = "None"; > = 1.0;

struct MeshInput
{
    float3 position : POSITION;
    float3 normal : NORMAL;
    float4 tangent : TANGENT;
    float2 uv : TEXCOORD0;
};

struct QuadInput
{
    float3 position : POSITION;
    float2 uv : TEXCOORD0;
};

// World units.
float3 worldPosition(float3 position)
{
    return mul(float4(position, 1.0), gWorld).xyz;
}

// World units into mm.
float millimetres(float length)
{
    return length * gUnitMm;
}

float3 millimetres(float3 v)
{
    return v * gUnitMm;
}

// Zero stays zero; no vector of a mesh that is scaled by 1e-9 to 1e9 is as short.
float3 worldUnit(float3 v)
{
    return v * rsqrt(max(dot(v, v), 1e-30));
}

// Unit vectors, whatever gWorld scales by. Right under rotation, mirror and any scale.
float3 worldNormal(float3 normal)
{
    return worldUnit(mul(normal, (float3x3)gWorldInverseTranspose));
}

// A mirrored world turns the bitangent round: cross(normal, tangent) does not take part in the mirroring.
float4 worldTangent(float4 tangent)
{
    return float4(worldUnit(mul(tangent.xyz, (float3x3)gWorld)), determinant((float3x3)gWorld) < 0.0 ? -tangent.w : tangent.w);
}

// A vector of the world along the mesh's own axes, with its length in the world: right under rotation, mirror and scales along the mesh's axes.
float3 meshAxes(float3 v)
{
    return float3(dot(v, worldUnit(gWorld[0].xyz)), dot(v, worldUnit(gWorld[1].xyz)), dot(v, worldUnit(gWorld[2].xyz)));
}

// Parallel light: w is the same everywhere.
bool lightParallel()
{
    float3 w = mul(gLightViewProjection, float4(0.0, 0.0, 0.0, 1.0)).xyz;
    return dot(w, w) <= 0.0;
}

// Where parallel light goes: its z rises along its rays.
float3 lightRays()
{
    return worldUnit(mul(gLightViewProjection, float4(0.0, 0.0, 1.0, 0.0)).xyz);
}

// From a point of the world to the light, world units; linear over a triangle. To its position; of parallel light along its rays, to the plane of
// gLightPosition.
float3 lightVector(float3 world)
{
    float3 toLight = gLightPosition - world;
    return lightParallel() ? dot(toLight, lightRays()) * lightRays() : toLight;
}

// Unit vector from a point of the world to the light, also where the point lies before the plane of parallel light.
float3 lightDirection(float3 world)
{
    return lightParallel() ? -lightRays() : worldUnit(gLightPosition - world);
}

// The light's right and up, unit vectors.
float3 lightRight()
{
    return worldUnit(mul(gLightViewProjection, float4(1.0, 0.0, 0.0, 0.0)).xyz);
}

float3 lightUp()
{
    return worldUnit(mul(gLightViewProjection, float4(0.0, 1.0, 0.0, 0.0)).xyz);
}

// mm across the light's view, half of its width, for each unit of w: what shadowFootprint takes.
float lightSpread()
{
    return millimetres(1.0) / max(length(mul(gLightViewProjection, float4(1.0, 0.0, 0.0, 0.0)).xyz), 1e-30);
}

#endif
