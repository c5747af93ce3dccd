// What the scene gives to every effect: transforms, light, camera, target; the vertex streams; clear values of the scripts.
// Conventions (docs/conventions.md): world space in mm, right-handed, row vectors; light colour is E/pi; one point light with its own pyramid.
#ifndef TEGUMENT_WORKSPACE_FXH
#define TEGUMENT_WORKSPACE_FXH

float4x4 gWorld : WORLD < string UIWidget = "None"; >;
float4x4 gWorldInverseTranspose : WORLDINVERSETRANSPOSE < string UIWidget = "None"; >;
float4x4 gViewProjection : VIEWPROJECTION < string UIWidget = "None"; >;
float4x4 gLightViewProjection : VIEWPROJECTION < string Object = "PointLight0"; string UIWidget = "None"; >;
float3 gLightPosition : POSITION < string Object = "PointLight0"; string Space = "World"; string UIName = "Light position"; string UIHelp = "mm"; >;
float gLightNear : NEARCLIP < string Object = "PointLight0"; string UIWidget = "None"; >;
float3 gLightColor : DIFFUSE < string Object = "PointLight0"; string UIName = "Light colour"; string UIWidget = "Color"; string UIHelp = "irradiance / pi, linear"; >;
float gLightFar : FARCLIP < string Object = "PointLight0"; string UIWidget = "None"; >;
float3 gCameraPosition : CAMERAPOSITION < string UIWidget = "None"; >;
float gLightFov : FIELDOFVIEW < string Object = "PointLight0"; string UIWidget = "None"; string UIHelp = "horizontal, radians"; >;

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

float3 worldPosition(float3 position)
{
    return mul(float4(position, 1.0), gWorld).xyz;
}

#endif
