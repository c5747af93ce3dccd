// What a lit pass knows of a point: from the mesh, the maps, the light and the translucent shadow map.
#ifndef TEGUMENT_PASSES_SURFACE_FXH
#define TEGUMENT_PASSES_SURFACE_FXH

Texture2D gNormalMap : NORMAL < float4 Fallback = { 0.5, 0.5, 1.0, 1.0 }; string UIName = "Normal map"; >;
Texture2D gEnergyAttenuationMap < string Producer = "EnergyAttenuation.fx/gEnergyAttenuationMap"; string ResourceName = "energy_attenuation.dds"; >;
SAMPLER2D(gNormal, LINEAR, CLAMP);
SAMPLER2D(gEnergyAttenuation, LINEAR, CLAMP);

struct SurfaceVarying
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
    float3 world : TEXCOORD1;
    float3 normal : TEXCOORD2;
    float4 tangent : TEXCOORD3;
    float4 lightClip : TEXCOORD4;
};

struct LitPoint
{
    float3 albedo;
    float scatters; // 1 skin, 0 plain material
    float3 normal;
    float3 toLight;
    float cosine; // N.L, signed
    float shadow; // 1 lit
    float2 tsmUv;
    float depth;     // as in the translucent shadow map
    float footprint; // of one of its texels, mm
    float3 axisX;    // the light's right
    float3 axisY;    // and up
};

SurfaceVarying surfaceVarying(MeshInput input)
{
    SurfaceVarying output;
    output.uv = input.uv;
    output.world = worldPosition(input.position);
    output.normal = mul(input.normal, (float3x3)gWorldInverseTranspose);
    output.tangent = float4(mul(input.tangent.xyz, (float3x3)gWorld), input.tangent.w);
    output.lightClip = mul(float4(output.world, 1.0), gLightViewProjection);
    output.position = float4(0.0, 0.0, 0.0, 1.0);
    return output;
}

LitPoint litPoint(SurfaceVarying input)
{
    LitPoint p;
    float4 colour = tex2D(gSkin, input.uv);
    float3 fromLight = input.world - gLightPosition;
    p.albedo = colour.rgb;
    p.scatters = colour.a;
    p.normal = surfaceNormal(input.normal, input.tangent, tex2D(gNormal, input.uv).xyz);
    p.toLight = safeNormalize(-fromLight);
    p.cosine = dot(p.normal, p.toLight);
    p.tsmUv = shadowCoordinate(input.lightClip);
    p.depth = shadowDepth(input.lightClip, fromLight);
    p.footprint = shadowFootprint(length(fromLight), gLightFov);
    p.axisX = safeNormalize(mul(gLightViewProjection, float4(1.0, 0.0, 0.0, 0.0)).xyz);
    p.axisY = safeNormalize(mul(gLightViewProjection, float4(0.0, 1.0, 0.0, 0.0)).xyz);
    float3 normal = safeNormalize(input.normal);
    float2 slope = shadowSlope(normal, p.axisX, p.axisY, p.toLight, p.footprint);
    p.shadow = shadowTest(SAMPLER2D_ARG(gTsm), p.tsmUv, p.depth, gShadowTolerance, slope) * shadowHorizon(dot(normal, p.toLight));
    return p;
}

// Where the light entered on its way to this point: u, v, and the way through the body (mm, or z/w); w = 0 where there is no such place. At the outline seen
// from the light a texel may hold a surface behind this one.
float4 lightEntry(LitPoint p)
{
    float4 texel = tsmEntry(SAMPLER2D_ARG(gTsm), p.tsmUv);
    float path = p.depth - texel.x;
    return float4(texel.yz, max(path, 0.0), path > -gShadowTolerance ? texel.w : 0.0);
}

// What the specular layer leaves of light that crosses the surface at this cosine.
float diffuseShare(float cosine)
{
    float albedo = tex2Dlod(gEnergyAttenuation, float4(saturate(cosine), gRoughness, 0.0, 0.0)).x;
    return energyDiffuseShare(albedo, gSpecularIntensity);
}

float3 enteringLight(LitPoint p)
{
    return irradianceEntering(p.albedo, gMix, gLightColor, p.cosine, p.shadow, diffuseShare(p.cosine));
}

#endif
