// Passes CoatSkin, CoatFront and Opacity: the shadow of strands on strands, by a deep opacity map (C. Yuksel and J. Keyser, Deep Opacity
// Maps, 2008): where light enters the coat, and how much of it strands take, from there to four depths. The front is the skin moved out
// by the coat's length: smooth, where strands' own first hits are not.
#ifndef TEGUMENT_PASSES_FUR_OPACITY_FXH
#define TEGUMENT_PASSES_FUR_OPACITY_FXH

Texture2D gCoatSkinMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, "R32F") bool Keeps = true; >;
Texture2D gCoatFrontMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, "R32F") bool Keeps = true; >;
Texture2D gCoatOpacityMap : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 0;
    string Format = "A16B16G16R16F"; bool Keeps = true; >;
TG_SAMPLER2D(gCoatSkin, POINT, CLAMP);
TG_SAMPLER2D(gCoatFront, POINT, CLAMP);
TG_SAMPLER2D(gCoatOpacity, LINEAR, CLAMP);

// Where the layers end, in thicknesses of the coat; what is deeper than the last counts for it.
static const float4 kCoatLayers = float4(0.25, 0.6, 1.2, 2.4);
static const float kCoatGap = 0.1;      // depth where no front is known, thicknesses: neither dark lines at hard edges nor light at borders
static const float kCoatOwn = 0.05;     // a strand does not shadow itself: that many thicknesses before it
static const float kCoatSoft = 1.4;     // texels of the map across which light is blurred, at least,
static const float kCoatBlur = 1.25;    // and pixels of the picture
static const float kCoatSkinSoft = 0.5; // across which the shadow of the skin begins, thicknesses,
static const float kCoatSkinLeast = 0.02; // and at least so many of the mesh's radii: a texel of the map on skin that light grazes

#define OPACITY_SCRIPT \
    "RenderColorTarget0=gCoatSkinMap; RenderDepthStencilTarget=gShadowDepthMap;" \
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=CoatSkin;" \
    "RenderColorTarget0=gCoatFrontMap; Clear=Color; Clear=Depth; Pass=CoatFront;" \
    "RenderColorTarget0=gCoatOpacityMap; RenderDepthStencilTarget=; Clear=Color;" \
    TG_LAYER_SCRIPT("gCoatShadowStrands", "gFurChild", "Opacity")
#define OPACITY_PASSES OPACITY_PASSES_OF(CoatFrontVS, OpacityVS, OpacityPS)
#define OPACITY_PASSES_OF(frontVS, opacityVS, opacityPS) \
    TG_PART_PASS(CoatSkin, "skin", CoatSkinVS, CoatSkinPS, TG_STATE_TWOSIDED) \
    TG_PART_PASS(CoatFront, "skin", frontVS, CoatFrontPS, TG_STATE_TWOSIDED) \
    TG_SEEN_LAYER_PASS(Opacity, "underfur", OPACITY_SHARE, "gCoatShadowStrands", opacityVS, opacityPS, TG_STATE_SUM)

float coatThickness()
{
    return gFurLength * gMeshRadius;
}

struct CoatFrontVarying
{
    float4 position : SV_Position;
    float2 light : TEXCOORD0; // distance from the light, mm; above 0: from outside
    float3 place : TEXCOORD1; // lightClip's x, y, w
};

CoatFrontVarying coatFrontVarying(TgVertexInput input, float height)
{
    FurVarying hull = furVarying(input, float2(height, 1.0), kFurNear);
    CoatFrontVarying output;
    float4 position = hull.lightClip;
    position.z = tgFurNearDepth(position.z, position.w);
    output.position = TG_HALF_PIXEL(position, gViewportSize);
    output.light = float2(furFromLight(hull.world), dot(tgWorldNormal(hull.normal), tgLightDirection(hull.world)));
    output.place = hull.lightClip.xyw;
    return output;
}

CoatFrontVarying CoatSkinVS(TgVertexInput input)
{
    return coatFrontVarying(input, 0.0);
}

CoatFrontVarying CoatFrontVS(TgVertexInput input)
{
    return coatFrontVarying(input, 1.0);
}

float4 CoatSkinPS(CoatFrontVarying input) : SV_Target0
{
    return float4(max(input.light.x, 1e-6), 0.0, 0.0, 1.0); // 0 means that there is nothing
}

// At borders and hard edges of the mesh the front gapes, and what the light sees through the gap is behind the skin, or the front's far
// side: there the coat begins one thickness before the skin; without skin the map holds minus the depth to be taken.
float4 CoatFrontPS(CoatFrontVarying input) : SV_Target0
{
    float skin = tex2Dlod(gCoatSkin, float4(input.place.xy / input.place.z * float2(0.5, -0.5) + 0.5, 0.0, 0.0)).x;
    float front = input.light.x;
    float gap = skin > 0.0 ? max(skin - tgMillimetres(coatThickness()), 1e-6) : -kCoatGap;
    bool gapes = skin > 0.0 ? front > skin : input.light.y < 0.0;
    return float4(gapes ? gap : max(front, 1e-6), 0.0, 0.0, 1.0);
}

// Depth behind the coat's front, thicknesses.
float coatDepth(float2 place, float distance)
{
    float front = tex2Dlod(gCoatFront, float4(place, 0.0, 0.0)).x;
    return front > 0.0 ? (distance - front) / max(tgMillimetres(coatThickness()), 1e-20) : -front;
}

struct OpacityVarying
{
    float4 position : SV_Position;
    float3 edge : TEXCOORD0;  // of tgRibbonCoverage
    float4 place : TEXCOORD1; // lightClip's x, y, w; distance from the light, mm
};

// Opacity that this strand adds before each of these depths, thicknesses.
float4 opacityBefore(OpacityVarying input, float4 layers)
{
    float2 place = input.place.xy / input.place.z * float2(0.5, -0.5) + 0.5;
    float depth = coatDepth(place, input.place.w);
    return tgRibbonCoverage(input.edge) * saturate((layers - depth) * 16.0 + 0.5);
}

float4 OpacityPS(OpacityVarying input) : SV_Target0
{
    return opacityBefore(input, kCoatLayers);
}

// Of strands, before this depth, thicknesses. pixel: of the picture there, in the world; what it cannot show would only flicker. layers,
// softest: as kCoatLayers, kCoatSoft.
float coatOpacity(float2 place, float depth, float pixel, float4 layers, float softest)
{
    float texel = 2.0 / kTgMapSize * (tgLightParallel() ? 1.0 : 0.5 * (gLightNear + gLightFar)) * tgLightSpread(); // amid the mesh, mm
    float4 sums = tex2Dlod(gCoatOpacity, float4(place, 0.0, log2(max(pixel * (kCoatBlur * tgMillimetres(1.0) / texel), softest))));
    return tgFurOpacity(sums, layers, depth);
}

// Share of the light that the skin leaves at this distance from the light: soft, for strands stand on it and lean over its edges. Taps
// stand one above the other: a mirror leaves them there.
float coatSkinOpen(float2 place, float distance)
{
    float2 aside = float2(0.0, 0.7 / kTgMapSize);
    float2 skin = float2(tex2Dlod(gCoatSkin, float4(place + 1.5 * aside, 0.0, 0.0)).x,
                         tex2Dlod(gCoatSkin, float4(place - 1.5 * aside, 0.0, 0.0)).x);
    // 0: there is none. Not tgShadowStored: vertex shader model 3 selects by c + (b - c), which loses what a large c stands beside.
    float soft = tgMillimetres(gMeshRadius) * max(kCoatSkinSoft * gFurLength, kCoatSkinLeast);
    float2 behind = saturate((distance - skin) / soft) * step(1e-6, skin);
    return 1.0 - 0.5 * dot(behind, 1.0);
}

// Share of the light that comes to a point of the coat. pixel: as above.
float coatOpen(float3 world, float pixel)
{
    float2 place = tgShadowCoordinate(mul(float4(world, 1.0), gLightViewProjection));
    float distance = furFromLight(world);
    float opacity = coatOpacity(place, coatDepth(place, distance) - kCoatOwn, pixel, kCoatLayers, kCoatSoft);
    return exp(-gCoatShadow * opacity) * coatSkinOpen(place, distance);
}

#endif
// SPDX-License-Identifier: MIT
