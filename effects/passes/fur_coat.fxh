// Pass Skin, and what every layer of a coat shares with it: where it is, how it is lit.
#ifndef TEGUMENT_PASSES_FUR_COAT_FXH
#define TEGUMENT_PASSES_FUR_COAT_FXH

Texture2D gFurColorMap < float4 Fallback = { 1.0, 1.0, 1.0, 1.0 }; string UIName = "Colour of the fur";
    string UIHelp = "with TEGUMENT_FUR_COLOR_MAP=1"; >;
TG_SAMPLER2D_SRGB(gFurColor, LINEAR, WRAP);

static const float kShadowTolerance = 0.005; // share of the mesh's radius

// centroid: far away a triangle is smaller than a pixel. With several samples a pixel its values would be taken at the pixel's centre, far
// outside of it. But where a pixel takes them changes from pixel to pixel then, so that their differences are no derivatives: those are the
// plain ones'.
struct FurVarying
{
    float4 position : SV_Position;
    centroid float3 rest : TEXCOORD0;   // of the skin below, from the bounding sphere's centre: along the mesh's axes, world units
    centroid float3 normal : TEXCOORD1; // mesh space
    centroid float3 world : TEXCOORD2;  // in the coat
    centroid float4 lightClip : TEXCOORD3;
    centroid float4 coat : TEXCOORD4; // furHeights, furMapPlace
    float4 plainRest : TEXCOORD5;     // furRound
    float3 plainNormal : TEXCOORD6;
#if TEGUMENT_FUR_VERTEX_LIGHT
    centroid float3 lit : TEXCOORD7;      // radiance of a white coat, less what it mirrors
    centroid float4 mirrored : TEXCOORD8; // that; shellWay
#endif
};

// In the coat: 0 skin, 1 tips.
float furHeight(FurVarying input)
{
    return input.coat.x;
}

// The same, and that of the layer above.
float2 furHeights(FurVarying input)
{
    return input.coat.xw;
}

// Texture coordinates of the mesh.
float2 furMapPlace(FurVarying input)
{
    return input.coat.yz;
}

// Of fur_rounds.fxh.
float furRound(FurVarying input)
{
    return input.plainRest.w;
}

// Of a point of the world from the light, mm. Parallel light has planes of equal distance.
float furFromLight(float3 world)
{
    return tgMillimetres(dot(tgLightDirection(world), tgLightVector(world)));
}

// Where tips hang, and how far: of this length, shares of the coat.
float3 furHang()
{
    return gFurLean * gFurDown;
}

// Of the mesh at rest, wherever the pose has brought the vertex: fur is found by it. From the bounding sphere's centre, world units.
float3 furPlace(TgVertexInput stored)
{
    return tgMeshAxes(tgWorldPosition(stored.position) - gBoundingCenter);
}

// The reverse of tgMeshAxes.
float3 furFromAxes(float3 v, float4x4 world)
{
    return v.x * tgWorldUnit(world[0].xyz) + v.y * tgWorldUnit(world[1].xyz) + v.z * tgWorldUnit(world[2].xyz);
}

float3 furFromAxes(float3 v)
{
    return furFromAxes(v, gWorld);
}

// A direction of the world in the axes of the mesh at rest.
float3 strandsAxes(float3 v, TgVertexInput stored)
{
    return vertexTurnedBack(tgMeshAxes(v), stored);
}

// heights: as furHeights; round: as furRound.
FurVarying furVarying(TgVertexInput stored, float2 heights, float round)
{
    TgMeshInput input = meshVertex(stored);
    FurVarying output;
    float3 skin = tgWorldPosition(input.position);
    output.rest = furPlace(stored);
    output.normal = input.normal;
    output.plainRest = float4(output.rest, round);
    output.plainNormal = input.normal;
#if TEGUMENT_FUR_VERTEX_LIGHT
    output.lit = 0.0;
    output.mirrored = 0.0;
#endif
    output.coat = float4(heights.x, kTgFurColorMap ? input.uv : float2(0.0, 0.0), heights.y);
    output.world = skin + tgFurStrand(tgWorldNormal(input.normal), furHang(), heights.x)
        * tgFurDistance(gFurLength, gMeshRadius, heights.x);
    output.lightClip = mul(float4(output.world, 1.0), gLightViewProjection);
    float4 position = mul(float4(output.world, 1.0), gViewProjection);
    position.z = tgFurNearDepth(position.z, position.w);
    output.position = TG_HALF_PIXEL(position, gViewportSize);
    return output;
}

FurVarying SkinVS(TgVertexInput input)
{
    return furVarying(input, float2(0.0, 1.0), kFurNear);
}

// mm, or z/w.
float furShadowTolerance()
{
    float range = kTgDepthInMillimetres ? tgMillimetres(1.0) : 1.0 / max(gLightFar - gLightNear, 1e-6);
    return kShadowTolerance * gMeshRadius * range;
}

// Whether the skin leaves light to this point of the coat; what the coat itself takes is tgFurTransmittance.
float furShadow(FurVarying input, float3 normal, float3 toLight)
{
    float depth = tgShadowDepth(input.lightClip, tgMillimetres(tgLightVector(input.world)));
    float2 slope = tgShadowSlope(normal, tgLightRight(), tgLightUp(), toLight, tgShadowFootprint(input.lightClip.w, tgLightSpread()));
    return tgShadowTest(TG_SAMPLER2D_ARG(gShadow), tgShadowCoordinate(input.lightClip), depth, furShadowTolerance(), slope);
}

// What the skin leaves of the light: one tap, for strands are narrower than texels of the map. distance: mm. As tgShadowLit of
// tgShadowDepth, in fewer slots of shader model 3: outside of the light's view and before it all is lit.
float furSkinShadow(float4 lightClip, float distance)
{
    float within = min(lightClip.w - max(abs(lightClip.x), abs(lightClip.y)), lightClip.z);
    float depth = (kTgDepthInMillimetres ? distance : lightClip.z / lightClip.w) - furShadowTolerance();
    float texel = tgShadowStored(tex2Dlod(gShadow, float4(tgShadowCoordinate(lightClip), 0.0, 0.0))).x;
    return within > 0.0 && depth > texel ? 0.0 : 1.0;
}

// Albedo of fur at this place: from root to tip, times the colour map.
float3 furAlbedo(FurVarying input)
{
    float3 albedo = lerp(gFurRootColor, gFurTipColor, furHeight(input));
    if (kTgFurColorMap)
        albedo *= tex2D(gFurColor, furMapPlace(input)).rgb;
    return albedo;
}

// Radiance of strands of this albedo in light of colour 1 that nothing shadows.
float3 furStrandLight(float3 albedo, float3 strand, float3 toLight, float3 toEye)
{
    float3 diffuse = albedo * tgFurDiffuse(strand, toLight, gFurMultiple) * (1.0 - gFurSpecular);
    return diffuse + gFurSpecular * tgFurSpecular(strand, toLight, toEye, gFurExponent);
}

#if TEGUMENT_LAMPS
// Radiance by lamps, as furRadiance() has it by the light of the workspace; of them the coat hides what it hides, other parts of the body
// nothing.
float3 furLamps(FurVarying input, float3 albedo, float3 normal, float3 strand, float3 toEye, float strandsShare)
{
    float3 sum = 0.0;
    [unroll] for (int i = 0; i < TEGUMENT_LAMPS; i++)
    {
        Lamp lamp = lampAt(i, input.world, 1.0);
        float cosine = dot(normal, lamp.toLight);
        float open = lerp(1.0, tgFurTransmittance(furHeight(input), cosine, gFurDensity, gFurLength), gFurKajiyaKay);
        float3 strands = furStrandLight(albedo, strand, lamp.toLight, toEye);
        sum += lerp(albedo * saturate(cosine), strands, gFurKajiyaKay * strandsShare) * lamp.light * open;
    }
    return sum;
}
#endif

// Radiance of what has this albedo: of strands, or of the skin between them, a dull surface. passed: share of the light that other coats
// let through.
float3 furRadiance(FurVarying input, float3 albedo, float strandsShare, float passed)
{
    float3 normal = tgWorldNormal(input.normal);
    float3 strand = tgFurTangent(normal, furHang(), furHeight(input));
    TgLight ours = ownLight(input.world);
    float3 toLight = ours.toLight;
    float3 toEye = tgSafeNormalize(gCameraPosition - input.world);
    float cosine = dot(normal, toLight);
    float3 dull = albedo * saturate(cosine);
    float3 strands = furStrandLight(albedo, strand, toLight, toEye);
    float open = lerp(1.0, tgFurTransmittance(furHeight(input), cosine, gFurDensity, gFurLength), gFurKajiyaKay);
    float3 light = ours.color * (open * passed * ownVisibility(input.world, normal, furShadow(input, normal, toLight)));
    float3 direct = lerp(dull, strands, gFurKajiyaKay * strandsShare) * light;
    return WITH_LAMPS(direct + albedo * gFurFill * tgFurFill(furHeight(input), gFurDensity, gFurMultiple),
                      furLamps(input, albedo, normal, strand, toEye, strandsShare));
}

float4 SkinPS(FurVarying input) : SV_Target0
{
    return float4(furRadiance(input, furAlbedo(input), 0.0, 1.0), 1.0);
}

#endif
// SPDX-License-Identifier: MIT
