// What a lit pass knows of a point from the mesh, its normal map and the light.
#ifndef TEGUMENT_PASSES_SURFACE_FXH
#define TEGUMENT_PASSES_SURFACE_FXH

Texture2D gNormalMap : NORMAL < float4 Fallback = { 0.5, 0.5, 1.0, 1.0 }; string UIName = "Normal map"; >;
TG_SAMPLER2D(gNormal, LINEAR, WRAP);

// What two lobes ask of a LitPoint: the length of the mean of the normals that a look-up of the normal map has covered, and how skin shines
// there, as factors of its roughness and intensity.
#if TEGUMENT_LOBES
Texture2D gShineMap : SHINE < float4 Fallback = { 0.50196, 0.50196, 0.0, 1.0 }; string UIName = "Shine map";
    string UIHelp = "red: times the roughness, green: times the specular intensity; 128 of 255 is 1"; >;
TG_SAMPLER2D(gShine, LINEAR, WRAP);

#define LOBE_MEMBERS float meanNormal; float2 shine;
#define TG_SKIN_INTENSITY(p) (gSpecularIntensity * p.shine.y)
#define SHINE_AT(p, uv) p.shine = tex2Dlod(gShine, float4(uv, 0.0, 0.0)).xy * (255.0 / 128.0);
#define LOBES_AT(p, texel) p.meanNormal = length((texel) * 2.0 - 1.0);
#else
#define LOBE_MEMBERS
#define TG_SKIN_INTENSITY(p) gSpecularIntensity
#define SHINE_AT(p, uv)
#define LOBES_AT(p, texel)
#endif

struct SurfaceVarying
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
    float3 world : TEXCOORD1; // world units
    float3 normal : TEXCOORD2;
    float4 tangent : TEXCOORD3;
    float4 lightClip : TEXCOORD4;
};

struct LitPoint
{
    float3 albedo;
    float scatters; // 1 skin, 0 plain material
    float3 normal;
    float3 meshNormal;
    float3 toLight;
    float cosine; // N.L, signed
    float shadow; // 1 lit
    float2 lightUv;
    float depth;     // as in the shadow map
    float footprint; // of one of its texels, mm
    float3 axisX;    // the light's right
    float3 axisY;    // and up
    float3 world;
    float3 light; // colour of the workspace's light
    MORE_LIGHT_MEMBERS
    LOBE_MEMBERS
};

SurfaceVarying surfaceVarying(TgVertexInput stored)
{
    TgMeshInput input = meshVertex(stored);
    SurfaceVarying output;
    output.uv = input.uv;
    output.world = tgWorldPosition(input.position);
    output.normal = tgWorldNormal(input.normal);
    output.tangent = tgWorldTangent(input.tangent);
    output.lightClip = mul(float4(output.world, 1.0), gLightViewProjection);
    output.position = float4(0.0, 0.0, 0.0, 1.0);
    return output;
}

// The surface on the picture.
SurfaceVarying SurfaceVS(TgVertexInput input)
{
    SurfaceVarying output = surfaceVarying(input);
    output.position = TG_HALF_PIXEL(mul(float4(output.world, 1.0), gViewProjection), gViewportSize);
    return output;
}

// White skin, unshadowed; colour and shadow are for the techniques to fill in. normal: with the normal map.
LitPoint surfacePoint(SurfaceVarying input, float3 normal)
{
    LitPoint p;
    float3 toLight = tgLightVector(input.world);
    p.albedo = float3(1.0, 1.0, 1.0);
    p.scatters = 1.0;
    p.normal = normal;
    p.meshNormal = tgSafeNormalize(input.normal);
    TgLight light = ownLight(input.world);
    p.world = input.world;
    p.light = light.color;
    p.toLight = light.toLight;
    p.cosine = dot(p.normal, p.toLight);
    p.shadow = 1.0;
    p.lightUv = tgShadowCoordinate(input.lightClip);
    p.depth = tgShadowDepth(input.lightClip, tgMillimetres(toLight));
    // Printed: by the distance.
    p.footprint = tgShadowFootprint(kTgFilterShadow || tgLightParallel() ? input.lightClip.w : length(toLight), tgLightSpread());
    p.axisX = tgLightRight();
    p.axisY = tgLightUp();
    MORE_LIGHT_AT(p, input.uv, input.world)
    LOBES_AT(p, float3(0.5, 0.5, 1.0))
    SHINE_AT(p, input.uv)
    return p;
}

LitPoint surfacePoint(SurfaceVarying input)
{
    float3 texel = tex2D(gNormal, input.uv).xyz;
    LitPoint p = surfacePoint(input, tgSurfaceNormal(input.normal, input.tangent, texel));
    LOBES_AT(p, texel)
    return p;
}

// map: of depths seen from the light.
float surfaceShadow(TG_SAMPLER2D_PARAM(map), LitPoint p)
{
    float2 slope = tgShadowSlope(p.meshNormal, p.axisX, p.axisY, p.toLight, p.footprint);
    float lit = tgShadowTest(TG_SAMPLER2D_ARG(map), p.lightUv, p.depth, gShadowTolerance, slope);
    return ownVisibility(p.world, p.meshNormal, lit * tgShadowHorizon(dot(p.meshNormal, p.toLight)));
}

#endif
// SPDX-License-Identifier: MIT
