// Pass Skin, and what every layer of a coat shares with it: where it is, how it is lit.
#ifndef TEGUMENT_PASSES_FUR_COAT_FXH
#define TEGUMENT_PASSES_FUR_COAT_FXH

Texture2D gFurColorMap < float4 Fallback = { 1.0, 1.0, 1.0, 1.0 }; string UIName = "Colour of the fur";
    string UIHelp = "with TEGUMENT_FUR_COLOR_MAP=1"; >;
TG_SAMPLER2D_SRGB(gFurColor, LINEAR, WRAP);

static const float kShadowTolerance = 0.005; // share of the mesh's radius

struct FurInput
{
    float3 position : POSITION;
    float3 normal : NORMAL;
    float2 uv : TEXCOORD0; // read with kTgFurColorMap only
};

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
    centroid float4 coat : TEXCOORD4; // height in the coat, uv, height of the layer above
    float4 plainRest : TEXCOORD5;     // round (fur_rounds.fxh)
    float3 plainNormal : TEXCOORD6;
};

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

FurVarying furVarying(FurInput input, float height)
{
    FurVarying output;
    float3 skin = tgWorldPosition(input.position);
    output.rest = tgMeshAxes(skin - gBoundingCenter);
    output.normal = input.normal;
    output.plainRest = float4(output.rest, kFurNear);
    output.plainNormal = input.normal;
    output.coat = float4(height, kTgFurColorMap ? input.uv : float2(0.0, 0.0), 1.0);
    output.world = skin + tgFurStrand(tgWorldNormal(input.normal), furHang(), height) * tgFurDistance(gFurLength, gMeshRadius, height);
    output.lightClip = mul(float4(output.world, 1.0), gLightViewProjection);
    float4 position = mul(float4(output.world, 1.0), gViewProjection);
    position.z = tgFurNearDepth(position.z, position.w);
    output.position = TG_HALF_PIXEL(position, gViewportSize);
    return output;
}

FurVarying SkinVS(FurInput input)
{
    return furVarying(input, 0.0);
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

// Albedo of fur at this place: from root to tip, times the colour map.
float3 furAlbedo(FurVarying input)
{
    float3 albedo = lerp(gFurRootColor, gFurTipColor, input.coat.x);
    if (kTgFurColorMap)
        albedo *= tex2D(gFurColor, input.coat.yz).rgb;
    return albedo;
}

// Radiance of strands of this albedo in light of colour 1 that nothing shadows.
float3 furStrandLight(float3 albedo, float3 strand, float3 toLight, float3 toEye)
{
    float3 diffuse = albedo * tgFurDiffuse(strand, toLight, gFurMultiple) * (1.0 - gFurSpecular);
    return diffuse + gFurSpecular * tgFurSpecular(strand, toLight, toEye, gFurExponent);
}

// Radiance of what has this albedo: of strands, or of the skin between them, a dull surface. passed: share of the light that other coats
// let through.
float3 furRadiance(FurVarying input, float3 albedo, float strandsShare, float passed)
{
    float3 normal = tgWorldNormal(input.normal);
    float3 strand = tgFurTangent(normal, furHang(), input.coat.x);
    float3 toLight = tgLightDirection(input.world);
    float3 toEye = tgSafeNormalize(gCameraPosition - input.world);
    float cosine = dot(normal, toLight);
    float3 dull = albedo * saturate(cosine);
    float3 strands = furStrandLight(albedo, strand, toLight, toEye);
    float open = lerp(1.0, tgFurTransmittance(input.coat.x, cosine, gFurDensity, gFurLength), gFurKajiyaKay);
    float3 light = gLightColor * (open * passed * furShadow(input, normal, toLight));
    float3 direct = lerp(dull, strands, gFurKajiyaKay * strandsShare) * light;
    return direct + albedo * gFurFill * tgFurFill(input.coat.x, gFurDensity, gFurMultiple);
}

float4 SkinPS(FurVarying input) : SV_Target0
{
    return float4(furRadiance(input, furAlbedo(input), 0.0, 1.0), 1.0);
}

#endif
