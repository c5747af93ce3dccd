// Skin by the library alone: d'Eon and Luebke's technique as an engine would write it, with its own parameters, targets and passes. The
// functions are those of tegument.hlsl; no other file is included. For compilers of entry points (FX_ENTRY); the technique is for the
// script's reader.
#ifndef TEGUMENT_MAP_SIZE
#define TEGUMENT_MAP_SIZE 1024
#endif
#ifdef FX_ENTRY
#define SAMPLER_OF(s, map, filter) SamplerState s
#else
#define TEGUMENT_HLSL_3
#define SAMPLER_OF(s, map, filter) sampler2D s { Texture = <map>; Filter = MIN_MAG_MIP_##filter; AddressU = CLAMP; AddressV = CLAMP; }
#endif
#define SAMPLER(s, filter) SAMPLER_OF(s, s##Map, filter)
#include "tegument.hlsl"

float4x4 gWorld : WORLD;
float4x4 gWorldInverseTranspose : WORLDINVERSETRANSPOSE;
float4x4 gViewProjection : VIEWPROJECTION;
float4x4 gLight : VIEWPROJECTION < string Object = "PointLight0"; >;
float3 gLightPosition : POSITION < string Object = "PointLight0"; string Space = "World"; >;
float gLightNear : NEARCLIP < string Object = "PointLight0"; >;
float3 gLightColor : DIFFUSE < string Object = "PointLight0"; >;
float gLightFar : FARCLIP < string Object = "PointLight0"; >;
float3 gCameraPosition : CAMERAPOSITION;
float gUnitMm : UNITMM = 1.0;
float4 gNothing = { 0.0, 0.0, 0.0, 0.0 };
float4 gInvalid = { 0.0, 0.0, 0.0, 1.0 };
float gFar = 1.0;

Texture2D gSkinMap : DIFFUSE < string ColorSpace = "sRGB"; float4 Fallback = { 0.8, 0.6, 0.5, 1.0 }; >;
Texture2D gNormalMap : NORMAL < float4 Fallback = { 0.5, 0.5, 1.0, 1.0 }; >;
SAMPLER(gSkin, LINEAR);
SAMPLER(gNormal, LINEAR);

#define SIZE int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE
#define TARGET(name, format) Texture2D name : RENDERCOLORTARGET < SIZE; int MipLevels = 1; string Format = format; >
TARGET(gTsmMap, "A32B32G32R32F");
TARGET(gStretchMap, "A16B16G16R16F");
TARGET(gLight1Map, "A16B16G16R16F");
TARGET(gLight2Map, "A16B16G16R16F");
TARGET(gLight3Map, "A16B16G16R16F");
TARGET(gLight4Map, "A16B16G16R16F");
TARGET(gLight5Map, "A16B16G16R16F");
TARGET(gLight6Map, "A16B16G16R16F");
TARGET(gBetweenMap, "A16B16G16R16F");
Texture2D gChartsMap : RENDERCOLORTARGET < SIZE; int MipLevels = 0; string Format = "A32B32G32R32F"; >;
Texture2D gEnergyMap : RENDERCOLORTARGET < int Width = 128; int Height = 128; int MipLevels = 1; string Format = "G16R16F"; >;
Texture2D gDepthMap : RENDERDEPTHSTENCILTARGET < SIZE; string Format = "D24S8"; >;
SAMPLER(gTsm, POINT);
SAMPLER(gStretch, POINT);
SAMPLER(gCharts, POINT);
SAMPLER(gEnergy, LINEAR);
SAMPLER(gBetween, POINT);
SAMPLER(gLight1, POINT);
SAMPLER(gLight2, POINT);
SAMPLER(gLight3, POINT);
SAMPLER(gLight4, POINT);
SAMPLER(gLight5, POINT);
SAMPLER_OF(gLinear, gLight6Map, LINEAR);

static const float kRoughness = 0.3;
static const float kIntensity = TG_SKIN_SPECULAR_INTENSITY;
static const float2 kPlain = float2(0.1, 0.5); // roughness and intensity of eyeballs

struct Mesh
{
    float3 position : POSITION;
    float3 normal : NORMAL;
    float4 tangent : TANGENT;
    float2 uv : TEXCOORD0;
};

struct Quad
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
};

struct Surface
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
    float3 world : TEXCOORD1;
    float3 normal : TEXCOORD2;
    float4 tangent : TEXCOORD3;
    float4 lightClip : TEXCOORD4;
};

Quad QuadVS(float3 position : POSITION, float2 uv : TEXCOORD0)
{
    Quad output;
    output.position = float4(position.xy, 0.0, 1.0);
    output.uv = uv;
    return output;
}

Surface surfaceAt(Mesh input)
{
    Surface output;
    output.world = tgWorldPosition(input.position, gWorld);
    output.normal = tgWorldNormal(input.normal, gWorldInverseTranspose);
    output.tangent = tgWorldTangent(input.tangent, gWorld);
    output.lightClip = mul(float4(output.world, 1.0), gLight);
    output.uv = input.uv;
    output.position = mul(float4(output.world, 1.0), gViewProjection);
    return output;
}

Surface PictureVS(Mesh input)
{
    return surfaceAt(input);
}

Surface MapVS(Mesh input)
{
    Surface output = surfaceAt(input);
    output.position = tgUnwrapPosition(input.uv, 0.0);
    return output;
}

Surface LightVS(Mesh input)
{
    Surface output = surfaceAt(input);
    output.position = output.lightClip;
    return output;
}

float3 toLightMm(Surface input)
{
    return tgLightVector(input.world, gLightPosition, gLight) * gUnitMm;
}

float4 TsmPS(Surface input) : SV_Target0
{
    return float4(tgShadowDepth(input.lightClip, toLightMm(input)), input.uv, 1.0);
}

float4 ChartsPS(Surface input) : SV_Target0
{
    float3 mm = input.world * gUnitMm;
    return float4(tgStretchEncode(ddx(mm), ddy(mm), TEGUMENT_MAP_SIZE), 0.0, 0.0);
}

// Outside the charts their mean, from the last mip level.
float4 StretchPS(Quad input) : SV_Target0
{
    float4 texel = gChartsMap.SampleLevel(gCharts, input.uv, 0.0);
    float4 all = gChartsMap.SampleLevel(gCharts, float2(0.5, 0.5), 20.0);
    return texel.w < 0.5 ? texel : float4(all.xy / max(1.0 - all.w, 1e-6), 0.0, 1.0);
}

float4 EnergyPS(Quad input) : SV_Target0
{
    return float4(tgEnergyTexel(tgEnergyDirectionalAlbedo(input.uv.x, input.uv.y)), 0.0, 1.0);
}

float diffuseShare(float cosine)
{
    return tgEnergyDiffuseShare(tgHalvesSum(gEnergyMap.SampleLevel(gEnergy, float2(saturate(cosine), kRoughness), 0.0).xy), kIntensity);
}

struct Lit
{
    float4 colour; // alpha: 1 skin, 0 plain
    float3 meshNormal;
    float3 normal;
    float3 toLight;
    float3 right;
    float3 up;
    float2 place; // in the light's map
    float depth;
    float footprint;
    float shadow;
};

Lit litAt(Surface input)
{
    Lit p;
    p.colour = gSkinMap.Sample(gSkin, input.uv);
    p.meshNormal = tgSafeNormalize(input.normal);
    p.normal = tgSurfaceNormal(input.normal, input.tangent, gNormalMap.Sample(gNormal, input.uv).xyz);
    p.toLight = tgLightDirection(input.world, gLightPosition, gLight);
    p.right = tgLightRight(gLight);
    p.up = tgLightUp(gLight);
    p.place = tgShadowCoordinate(input.lightClip);
    p.depth = tgShadowDepth(input.lightClip, toLightMm(input));
    p.footprint = tgShadowFootprint(input.lightClip.w, tgLightSpread(gLight, gUnitMm));
    float2 slope = tgShadowSlope(p.meshNormal, p.right, p.up, p.toLight, p.footprint);
    p.shadow = tgShadowTest(TG_SAMPLER2D_ARG(gTsm), p.place, p.depth, TG_SKIN_SHADOW_TOLERANCE, slope);
    p.shadow *= tgShadowHorizon(dot(p.meshNormal, p.toLight));
    return p;
}

float3 entering(Lit p)
{
    float cosine = dot(p.normal, p.toLight);
    return tgIrradianceEntering(p.colour.rgb, TG_SKIN_MIX, gLightColor, cosine, p.shadow, diffuseShare(cosine));
}

// u, v where the light entered, way through the body, 1 where there is such a place.
float4 entryOf(Lit p)
{
    float4 texel = tgTsmEntry(TG_SAMPLER2D_ARG(gTsm), p.place);
    float path = p.depth - texel.x;
    return float4(texel.yz, max(path, 0.0), path > -TG_SKIN_SHADOW_TOLERANCE ? texel.w : 0.0);
}

float4 IrradiancePS(Surface input) : SV_Target0
{
    Lit p = litAt(input);
    float4 entry = entryOf(p);
    float3 litNormal = tgTsmNormal(TG_SAMPLER2D_ARG(gTsm), p.place, p.right, p.up, p.toLight, p.footprint, 1.0);
    float thickness = tgTransmissionThickness(entry.z, dot(p.meshNormal, p.toLight), p.meshNormal, litNormal);
    float alpha = tgTransmissionEncode(entry.w > 0.5 ? thickness : kTgOpaqueDistance);
    return float4(tgIrradianceBounded(entering(p), kTgLargestLight), p.colour.a > 0.5 ? alpha : 1.0);
}

float4 convolved(TG_SAMPLER2D_PARAM(map), float2 uv, float2 along, float before, float after)
{
    float4 stretch = gStretchMap.SampleLevel(gStretch, uv, 0.0);
    float density = dot(tgGaussianDensity(stretch), along);
    float middle = tgLightParallel(gLight) ? 1.0 : 0.5 * (gLightNear + gLightFar);
    float present = tgGaussianPresent(tgShadowFootprint(middle, tgLightSpread(gLight, gUnitMm)), density);
    float spacing = tgGaussianSpacing(tgGaussianIncrement(before, after, density, present));
    return tgGaussianConvolve(TG_SAMPLER2D_ARG(map), uv, along / TEGUMENT_MAP_SIZE, tgGaussianReach(spacing, stretch));
}

#define CONVOLUTION(k, map, before, after) \
    float4 U##k##PS(Quad input) : SV_Target0 \
    { return convolved(TG_SAMPLER2D_ARG(map), input.uv, float2(1.0, 0.0), before, after); } \
    float4 V##k##PS(Quad input) : SV_Target0 \
    { return convolved(TG_SAMPLER2D_ARG(gBetween), input.uv, float2(0.0, 1.0), before, after); }
CONVOLUTION(1, gLight1, 0.0, kTgSkinWidth[1])
CONVOLUTION(2, gLight2, kTgSkinWidth[1], kTgSkinWidth[2])
CONVOLUTION(3, gLight3, kTgSkinWidth[2], kTgSkinWidth[3])
CONVOLUTION(4, gLight4, kTgSkinWidth[3], kTgSkinWidth[4])
CONVOLUTION(5, gLight5, kTgSkinWidth[4], kTgSkinWidth[5])

float4 here(float4 texel, float3 unblurred)
{
    return tgSeamValidity(texel) > 0.0 ? texel : float4(unblurred, tgTransmissionEncode(kTgOpaqueDistance));
}

// Light of one Gaussian where it entered; thickness: the alpha of the map before it, here.
float3 there(float4 texel, float thickness, float4 gaussian, float apart)
{
    float through = tgTransmissionDecode(thickness, (gLightFar - gLightNear) * gUnitMm);
    return gaussian.rgb * texel.rgb * (tgSeamValidity(texel) * tgTransmissionShare(through, gaussian.w, apart));
}

float3 diffused(Surface input, Lit p)
{
    float3 unblurred = entering(p);
    float4 m2 = here(gLight2Map.SampleLevel(gLinear, input.uv, 0.0), unblurred);
    float4 m3 = here(gLight3Map.SampleLevel(gLinear, input.uv, 0.0), unblurred);
    float4 m4 = here(gLight4Map.SampleLevel(gLinear, input.uv, 0.0), unblurred);
    float4 m5 = here(gLight5Map.SampleLevel(gLinear, input.uv, 0.0), unblurred);
    float4 m6 = here(gLight6Map.SampleLevel(gLinear, input.uv, 0.0), unblurred);
    float3 sum = unblurred * kTgSkinProfile[0].rgb + m2.rgb * kTgSkinProfile[1].rgb + m3.rgb * kTgSkinProfile[2].rgb +
                 m4.rgb * kTgSkinProfile[3].rgb + m5.rgb * kTgSkinProfile[4].rgb + m6.rgb * kTgSkinProfile[5].rgb;
    float4 entry = entryOf(p);
    float apart = tgTransmissionScale(input.world * gUnitMm, input.uv) * length(input.uv - entry.xy);
    float3 passed = there(gLight4Map.SampleLevel(gLinear, entry.xy, 0.0), m3.w, kTgSkinProfile[3], apart) +
                    there(gLight5Map.SampleLevel(gLinear, entry.xy, 0.0), m4.w, kTgSkinProfile[4], apart) +
                    there(gLight6Map.SampleLevel(gLinear, entry.xy, 0.0), m5.w, kTgSkinProfile[5], apart);
    return sum + entry.w * passed;
}

float4 PicturePS(Surface input) : SV_Target0
{
    Lit p = litAt(input);
    float3 toEye = tgSafeNormalize(gCameraPosition - input.world);
    float3 skin = diffused(input, p) * tgIrradianceColour(p.colour.rgb, 1.0 - TG_SKIN_MIX) * diffuseShare(dot(p.normal, toEye));
    float3 plain = p.colour.rgb * gLightColor * (saturate(dot(p.normal, p.toLight)) * p.shadow);
    float2 lobe = lerp(kPlain, float2(kRoughness, kIntensity), p.colour.a);
    float3 reflected = gLightColor * p.shadow * tgKelemenSpecular(p.normal, p.toLight, toEye, lobe.x, lobe.y);
    return float4(lerp(plain, skin, p.colour.a) + reflected, 1.0);
}

#ifndef FX_ENTRY
#define STATE(test, cull) \
    ZEnable = test; ZWriteEnable = test; ZFunc = LESSEQUAL; ColorWriteEnable = 15; CullMode = cull; AlphaBlendEnable = FALSE; \
    AlphaTestEnable = FALSE; StencilEnable = FALSE; SRGBWriteEnable = FALSE;
#define DRAW(name, what, vs, ps, states) \
    pass name < string Script = what; > { VertexShader = compile vs_3_0 vs(); PixelShader = compile ps_3_0 ps(); states }
#define QUAD(name, ps) DRAW(name, "Draw=Buffer;", QuadVS, ps, STATE(FALSE, NONE))
technique Skin < string Script =
    "RenderColorTarget0=gTsmMap; RenderDepthStencilTarget=gDepthMap;"
    "ClearSetColor=gNothing; ClearSetDepth=gFar; Clear=Color; Clear=Depth; Pass=Tsm;"
    "RenderColorTarget0=gChartsMap; RenderDepthStencilTarget=; ClearSetColor=gInvalid; Clear=Color; Pass=Charts;"
    "RenderColorTarget0=gStretchMap; Pass=Stretch; RenderColorTarget0=gEnergyMap; Pass=Energy;"
    "RenderColorTarget0=gLight1Map; Clear=Color; Pass=Irradiance;"
    "RenderColorTarget0=gBetweenMap; Clear=Color; Pass=U1; RenderColorTarget0=gLight2Map; Clear=Color; Pass=V1;"
    "RenderColorTarget0=gBetweenMap; Clear=Color; Pass=U2; RenderColorTarget0=gLight3Map; Clear=Color; Pass=V2;"
    "RenderColorTarget0=gBetweenMap; Clear=Color; Pass=U3; RenderColorTarget0=gLight4Map; Clear=Color; Pass=V3;"
    "RenderColorTarget0=gBetweenMap; Clear=Color; Pass=U4; RenderColorTarget0=gLight5Map; Clear=Color; Pass=V4;"
    "RenderColorTarget0=gBetweenMap; Clear=Color; Pass=U5; RenderColorTarget0=gLight6Map; Clear=Color; Pass=V5;"
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Picture;"; >
{
    DRAW(Tsm, "Draw=Geometry;", LightVS, TsmPS, STATE(TRUE, NONE))
    DRAW(Charts, "Draw=Geometry;", MapVS, ChartsPS, STATE(FALSE, NONE))
    QUAD(Stretch, StretchPS)
    QUAD(Energy, EnergyPS)
    DRAW(Irradiance, "Draw=Geometry;", MapVS, IrradiancePS, STATE(FALSE, NONE))
    QUAD(U1, U1PS)
    QUAD(V1, V1PS)
    QUAD(U2, U2PS)
    QUAD(V2, V2PS)
    QUAD(U3, U3PS)
    QUAD(V3, V3PS)
    QUAD(U4, U4PS)
    QUAD(V4, V4PS)
    QUAD(U5, U5PS)
    QUAD(V5, V5PS)
    DRAW(Picture, "Draw=Geometry;", PictureVS, PicturePS, STATE(TRUE, CW))
}
#endif
