// Pass Shells: the coat's layers, looked up in a fur map.
#ifndef TEGUMENT_PASSES_FUR_SHELL_FXH
#define TEGUMENT_PASSES_FUR_SHELL_FXH

Texture2D gFurSphereMap < string Generator = "fur sphere map"; float4 Fallback = { 1.0, 1.0, 1.0, 0.0 };
    string UIName = "Fur as a sphere map"; >;
TextureCube gFurCubeMap < string Generator = "fur cube map"; float4 Fallback = { 1.0, 1.0, 1.0, 0.0 }; string UIName = "Fur as a cube map";
    >;
TG_SAMPLER2D(gFurSphere, LINEAR, CLAMP);
TG_SAMPLERCUBE(gFurCube, LINEAR);

static const float kFurFaint = 0.002; // coverage that a layer seen from afar may leave out: 32 of them add up
static const float kFurKernel = 1.7;   // bilinear texels of the fitting level are a mean over sqrt(3) times a pixel's width

// 1 / distance from the eye.
float shellNearness(FurVarying input)
{
    float3 fromEye = input.world - gCameraPosition;
    return rsqrt(dot(fromEye, fromEye));
}

// How far over the skin a ray goes while it falls by the coat's height, in the world.
float shellWay(FurVarying input)
{
    float3 normal = tgWorldNormal(input.normal);
    float3 view = tgSafeNormalize(input.world - gCameraPosition);
    float3 strand = normal + 2.0 * furHeight(input) * furHang();
    return tgFurWayOver(view, normal, strand) * gFurLength * gMeshRadius;
}

FurVarying shellVarying(TgVertexInput input, float layer, float round)
{
    float height = tgFurSpread(tgFurLayerHeight(layer, gFurLayers, gFurOuterFirst), gFurSpread);
    float above = pow(max((layer + 2.0) / max(gFurLayers, 1.0), 1e-6), gFurSpread); // beyond the tips, too
    FurVarying output = furVarying(input, float2(height, above), round);
#if TEGUMENT_FUR_VERTEX_LIGHT
    float passed = furHullShadow(output);
    output.mirrored = float4(furRadiance(output, 0.0, 1.0, passed), shellWay(output));
    output.lit = furRadiance(output, 1.0, 1.0, passed) - output.mirrored.rgb;
#endif
    return output;
}

// Radiance of strands of this albedo.
float3 shellRadiance(FurVarying input, float3 albedo)
{
#if TEGUMENT_FUR_VERTEX_LIGHT
    return albedo * input.lit + input.mirrored.rgb;
#else
    return furRadiance(input, albedo, 1.0, furHullShadow(input));
#endif
}

FurVarying ShellsVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    return shellVarying(input, TG_LAYER_INDEX(gFurLayer), kFurNear);
}

FurVarying BehindVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    return shellVarying(input, TG_LAYER_INDEX(gFurLayer), kFurBehind);
}

FurVarying CoatEndVS(TgVertexInput input)
{
    FurVarying output = furVarying(input, float2(1.0, 1.0), kFurNear);
    output.position = furEndPosition(output.position);
    return output;
}

float4 CoatEndPS(FurVarying input) : SV_Target0
{
    return float4(shellNearness(input), 0.0, 0.0, 1.0);
}

// Slope of the map's heights against which the ray falls: how much they rise on its way over the skin while it falls by the coat's height.
// side: of a pixel, radians of the map.
float shellSlope(FurVarying input, float side)
{
#if TEGUMENT_FUR_VERTEX_LIGHT
    float way = input.mirrored.w;
#else
    float way = shellWay(input);
#endif
    float pixel = max(length(ddx(input.plainRest.xyz)), length(ddy(input.plainRest.xyz)));
    return tgFurHeightSlope(gFurDeviation, gFurGrain) * side * way / max(pixel, 1e-20);
}

// Of a pixel, radians of the map: its shorter and its longer side.
float2 shellSides(float3 v)
{
    float2 sides = float2(length(ddx(v)), length(ddy(v)));
    float longer = max(sides.x, sides.y);
    return float2(clamp(min(sides.x, sides.y), 0.01 * longer, longer), longer);
}

// The map is looked up finer than isotropic filters do it, by a pixel's shorter side: along the longer one layer upon layer is looked up
// anyway.
float shellShrink(float2 sides)
{
    return gFurDeviation > 0.0 ? max(sides.x / max(sides.y, 1e-20), 0.01) : 1.0;
}

// What neighbouring pixels tell of this one; found before any of them may leave.
struct ShellPixel
{
    float2 sides;
    float slope; // of shellSlope
    float left;  // below 0: it belongs to the other round
};

ShellPixel shellPixel(FurVarying input, float2 pixel, float3 plain)
{
    ShellPixel own;
    own.sides = shellSides(plain);
    own.slope = shellSlope(input, own.sides.y);
    own.left = furInRound(shellNearness(input), pixel, furRound(input));
    return own;
}

// Whether the map has to be looked up. In the printed settings look-ups take their level from neighbouring pixels: no pixel may leave
// before.
bool shellAsked(ShellPixel own)
{
    return !kTgCorrected || !TG_LEAVES_EARLY || own.left >= 0.0;
}

// texel: of a fur map, colour and coverage (or height) of its strands. Only what is drawn is lit; left: below 0 what is not.
float4 shell(FurVarying input, ShellPixel own, float4 texel, out float left)
{
    float variance = tgFurHeightVariance(gFurDeviation, gFurGrain, kFurKernel * own.sides.x, texel.a);
    float afar = tgFurAfar(variance, gFurSoftness) * gFurTaper * (1.0 - gFurOuterFirst);
    float mean = tgFurMeanCoverage(texel.a, furHeights(input), variance, gFurSoftness, own.slope);
    float coverage = tgFurCoverage(texel.a, furHeight(input), gFurTaper, gFurSoftness);
    float tested = lerp(coverage - max(gFurAlphaTest, gFurOuterFirst * 0.5), mean - kFurFaint, afar);
    left = own.left < 0.0 ? -1.0 : tested;
    float drawn = lerp(tgFurLayerCoverage(coverage, gFurLayers), mean, afar);
    float4 color = float4(0.0, 0.0, 0.0, max(drawn, gFurOuterFirst));
    float3 albedo = furAlbedo(input) * texel.rgb;
    [branch] if (left >= 0.0)
        color.rgb = shellRadiance(input, albedo);
    return color;
}

// Of several samples, look-ups by centroid places have derivatives of their own (fur_coat.fxh): the plain ones' are given to them. In the
// printed settings they keep their own. A curl moves the place, but neighbouring pixels' alike.
float4 cubeShell(FurVarying input, float2 pixel, float3 v, float3 plain)
{
    ShellPixel own = shellPixel(input, pixel, plain);
    float3 across = ddx(plain);
    float3 down = ddy(plain);
    float shrink = shellShrink(own.sides);
    float3 place = tgFurCurled(v, furHeight(input), gFurCurl);
    float left = -1.0;
    float4 color = 0.0;
    [branch] if (shellAsked(own))
    {
        float4 texel = 0.0;
        if (kTgCorrected)
            texel = texCUBEgrad(gFurCube, place, across * shrink, down * shrink);
        else
            texel = texCUBEbias(gFurCube, float4(place, log2(shrink)));
        color = shell(input, own, texel, left);
    }
    clip(left);
    return color;
}

float4 sphereShell(FurVarying input, float2 pixel, float3 v, float3 plain)
{
    ShellPixel own = shellPixel(input, pixel, plain);
    float2 round = tgFurSphereCoordinate(plain);
    float2 across = ddx(round);
    float2 down = ddy(round);
    float shrink = shellShrink(own.sides);
    float2 place = tgFurSphereCoordinate(tgFurCurled(v, furHeight(input), gFurCurl));
    float left = -1.0;
    float4 color = 0.0;
    [branch] if (shellAsked(own))
    {
        float4 texel = 0.0;
        if (kTgCorrected)
            texel = tex2Dgrad(gFurSphere, place, across * shrink, down * shrink);
        else
            texel = tex2Dbias(gFurSphere, float4(place, 0.0, log2(shrink)));
        color = shell(input, own, texel, left);
    }
    clip(left);
    return color;
}

float4 CubePositionPS(TG_PIXEL_INPUT(FurVarying, input)) : SV_Target0
{
    return cubeShell(input, TG_PIXEL_CENTRE(input), tgFurDirection(input.rest), tgFurDirection(input.plainRest.xyz));
}

float4 CubeNormalPS(TG_PIXEL_INPUT(FurVarying, input)) : SV_Target0
{
    return cubeShell(input, TG_PIXEL_CENTRE(input), tgFurDirection(input.normal), tgFurDirection(input.plainNormal));
}

float4 CubeCombinedPS(TG_PIXEL_INPUT(FurVarying, input)) : SV_Target0
{
    return cubeShell(input, TG_PIXEL_CENTRE(input), tgFurCombinedVector(input.rest, input.normal),
                     tgFurCombinedVector(input.plainRest.xyz, input.plainNormal));
}

float4 SpherePositionPS(TG_PIXEL_INPUT(FurVarying, input)) : SV_Target0
{
    return sphereShell(input, TG_PIXEL_CENTRE(input), tgFurDirection(input.rest), tgFurDirection(input.plainRest.xyz));
}

float4 SphereNormalPS(TG_PIXEL_INPUT(FurVarying, input)) : SV_Target0
{
    return sphereShell(input, TG_PIXEL_CENTRE(input), tgFurDirection(input.normal), tgFurDirection(input.plainNormal));
}

float4 SphereCombinedPS(TG_PIXEL_INPUT(FurVarying, input)) : SV_Target0
{
    return sphereShell(input, TG_PIXEL_CENTRE(input), tgFurCombinedVector(input.rest, input.normal),
                       tgFurCombinedVector(input.plainRest.xyz, input.plainNormal));
}

#endif
// SPDX-License-Identifier: MIT
