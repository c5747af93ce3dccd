// Passes Skin and Shells: the mesh below the coat, and the coat's layers.
#ifndef TEGUMENT_PASSES_FUR_SHELL_FXH
#define TEGUMENT_PASSES_FUR_SHELL_FXH

Texture2D gFurSphereMap < float4 Fallback = { 1.0, 1.0, 1.0, 0.0 }; string UIName = "Fur as a sphere map"; >;
TextureCube gFurCubeMap < float4 Fallback = { 1.0, 1.0, 1.0, 0.0 }; string UIName = "Fur as a cube map"; >;
Texture2D gFurColorMap < float4 Fallback = { 1.0, 1.0, 1.0, 1.0 }; string UIName = "Colour of the fur"; string UIHelp = "with TEGUMENT_FUR_COLOR_MAP=1"; >;
SAMPLER2D(gFurSphere, LINEAR, CLAMP);
SAMPLERCUBE(gFurCube, LINEAR);
SAMPLER2D_SRGB(gFurColor, LINEAR, WRAP);

struct FurInput
{
    float3 position : POSITION;
    float3 normal : NORMAL;
    float2 uv : TEXCOORD0; // read with kFurColorMap only
};

struct FurVarying
{
    float4 position : SV_Position;
    float3 rest : TEXCOORD0;   // of the skin below, mesh space, from the bounding sphere's centre
    float3 normal : TEXCOORD1; // mesh space
    float3 world : TEXCOORD2;  // of the skin below
    float4 lightClip : TEXCOORD3;
    float3 coat : TEXCOORD4; // height in the coat, uv
};

FurVarying furVarying(FurInput input, float height)
{
    FurVarying output;
    output.world = worldPosition(input.position);
    // Back into the mesh's own axes: with a rotation and one scale the transpose is the inverse, but for a length that does not matter.
    output.rest = mul((float3x3)gWorld, output.world - gBoundingCenter);
    output.normal = input.normal;
    output.coat = float3(height, kFurColorMap ? input.uv : float2(0.0, 0.0));
    output.lightClip = mul(float4(output.world, 1.0), gLightViewProjection);
    float3 normal = safeNormalize(mul(input.normal, (float3x3)gWorldInverseTranspose));
    float3 world = output.world + furStrand(normal, gFurLean, height) * furDistance(gFurLength, gMeshRadius, height);
    output.position = HALF_PIXEL(mul(float4(world, 1.0), gViewProjection), gViewportSize);
    return output;
}

FurVarying SkinVS(FurInput input)
{
    return furVarying(input, 0.0);
}

FurVarying ShellsVS(LAYER_INPUT(FurInput, input))
{
    return furVarying(input, furLayerHeight(LAYER_INDEX(gFurLayer), gFurLayers, gFurOuterFirst));
}

// The light that reaches the coat at this point. Its own length above the skin is no shadow.
float furShadow(FurVarying input, float3 normal, float3 toLight)
{
    float3 fromLight = input.world - gLightPosition;
    float3 axisX = safeNormalize(mul(gLightViewProjection, float4(1.0, 0.0, 0.0, 0.0)).xyz);
    float3 axisY = safeNormalize(mul(gLightViewProjection, float4(0.0, 1.0, 0.0, 0.0)).xyz);
    float2 slope = shadowSlope(normal, axisX, axisY, toLight, shadowFootprint(length(fromLight), gLightFov));
    float range = kDepthInMillimetres ? 1.0 : 1.0 / max(gLightFar - gLightNear, 1e-6);
    float tolerance = (0.005 + gFurLength) * gMeshRadius * range;
    return shadowTest(SAMPLER2D_ARG(gShadow), shadowCoordinate(input.lightClip), shadowDepth(input.lightClip, fromLight), tolerance, slope);
}

// Albedo of fur at this place: from root to tip, times the colour map.
float3 furAlbedo(FurVarying input)
{
    float3 albedo = lerp(gFurRootColor, gFurTipColor, input.coat.x);
    if (kFurColorMap)
        albedo *= tex2D(gFurColor, input.coat.yz).rgb;
    return albedo;
}

// Radiance of a strand. tint: of the fur map.
float3 furRadiance(FurVarying input, float3 tint)
{
    float3 normal = safeNormalize(mul(input.normal, (float3x3)gWorldInverseTranspose));
    float3 surface = input.world + furStrand(normal, gFurLean, input.coat.x) * furDistance(gFurLength, gMeshRadius, input.coat.x);
    float3 strand = furTangent(normal, gFurLean, input.coat.x);
    float3 toLight = safeNormalize(gLightPosition - surface);
    float3 toEye = safeNormalize(gCameraPosition - surface);
    float cosine = dot(normal, toLight);
    float3 albedo = furAlbedo(input) * tint;
    float3 strands = albedo * furDiffuse(strand, toLight, gFurMultiple) + gFurSpecular * furSpecular(strand, toLight, toEye, gFurExponent);
    strands *= furTransmittance(input.coat.x, cosine, gFurDensity);
    float3 dull = albedo * saturate(cosine);
    return lerp(dull, strands, gFurKajiyaKay) * gLightColor * furShadow(input, normal, toLight);
}

float4 SkinPS(FurVarying input) : SV_Target0
{
    float3 normal = safeNormalize(mul(input.normal, (float3x3)gWorldInverseTranspose));
    float3 toLight = safeNormalize(gLightPosition - input.world);
    float cosine = dot(normal, toLight);
    float open = lerp(1.0, furTransmittance(0.0, cosine, gFurDensity), gFurKajiyaKay);
    return float4(furAlbedo(input) * gLightColor * saturate(cosine) * open * furShadow(input, normal, toLight), 1.0);
}

// texel: of a fur map, colour and coverage (or height) of its strands.
float4 shell(FurVarying input, float4 texel)
{
    float coverage = furCoverage(texel.a, input.coat.x, gFurTaper, gFurSoftness);
    clip(coverage - max(gFurAlphaTest, gFurOuterFirst * 0.5));
    return float4(furRadiance(input, texel.rgb), max(coverage, gFurOuterFirst));
}

float4 cubeShell(FurVarying input, float3 v)
{
    return shell(input, texCUBE(gFurCube, furCurled(v, input.coat.x, gFurCurl)));
}

float4 sphereShell(FurVarying input, float3 v)
{
    return shell(input, tex2D(gFurSphere, furSphereCoordinate(furCurled(v, input.coat.x, gFurCurl))));
}

float4 CubePositionPS(FurVarying input) : SV_Target0
{
    return cubeShell(input, furDirection(input.rest));
}

float4 CubeNormalPS(FurVarying input) : SV_Target0
{
    return cubeShell(input, furDirection(input.normal));
}

float4 CubeCombinedPS(FurVarying input) : SV_Target0
{
    return cubeShell(input, furCombinedVector(input.rest, input.normal));
}

float4 SpherePositionPS(FurVarying input) : SV_Target0
{
    return sphereShell(input, furDirection(input.rest));
}

float4 SphereNormalPS(FurVarying input) : SV_Target0
{
    return sphereShell(input, furDirection(input.normal));
}

float4 SphereCombinedPS(FurVarying input) : SV_Target0
{
    return sphereShell(input, furCombinedVector(input.rest, input.normal));
}

#endif
