// Pass Shells: the coat's layers, looked up in a fur map.
#ifndef TEGUMENT_PASSES_FUR_SHELL_FXH
#define TEGUMENT_PASSES_FUR_SHELL_FXH

Texture2D gFurSphereMap < float4 Fallback = { 1.0, 1.0, 1.0, 0.0 }; string UIName = "Fur as a sphere map"; >;
TextureCube gFurCubeMap < float4 Fallback = { 1.0, 1.0, 1.0, 0.0 }; string UIName = "Fur as a cube map"; >;
SAMPLER2D(gFurSphere, LINEAR, CLAMP);
SAMPLERCUBE(gFurCube, LINEAR);

FurVarying ShellsVS(LAYER_INPUT(FurInput, input))
{
    return furVarying(input, furSpread(furLayerHeight(LAYER_INDEX(gFurLayer), gFurLayers, gFurOuterFirst), gFurSpread));
}

// texel: of a fur map, colour and coverage (or height) of its strands.
float4 shell(FurVarying input, float4 texel)
{
    float coverage = furCoverage(texel.a, input.coat.x, gFurTaper, gFurSoftness);
    clip(coverage - max(gFurAlphaTest, gFurOuterFirst * 0.5));
    return float4(furRadiance(input, furAlbedo(input) * texel.rgb, 1.0), max(furLayerCoverage(coverage, gFurLayers), gFurOuterFirst));
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
