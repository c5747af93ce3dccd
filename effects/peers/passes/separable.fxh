// Passes AlongX and AlongY: the light of gLightMap blurred along the axes of the picture into gScatterMap.
#ifndef TEGUMENT_PEERS_PASSES_SEPARABLE_FXH
#define TEGUMENT_PEERS_PASSES_SEPARABLE_FXH

float3 gSeparableStrength < UI_COLOUR("Strength") float UIMin = 0.0; float UIMax = 1.0;
    string UIHelp = "share of each colour that diffuses"; > = { 1.0, 1.0, 1.0 };
float gSeparableUnit < UI_SLIDER("Width", 0.0, 10.0, 0.01)
    string UIHelp = "mm for each unit of the kernel; corrected: 1 is the skin profile"; > = TG_PEER_SEPARABLE_UNIT;

Texture2D gScatterXMap : RENDERCOLORTARGET < PICTURE_TARGET("A16B16G16R16F") >;
TG_SAMPLER2D(gScatterX, LINEAR, CLAMP);
TG_SAMPLER2D_OF(gBetween, gShadeMap, LINEAR, CLAMP);

// Passes with as many samples. Rows of the kernels' tables: the first, and how many pairs of samples follow.
#define SEPARABLE_STEPS(samples, first, pairs) \
float4 AlongX##samples##PS(TgQuadVarying input) : SV_Target0 \
{ \
    return along(TG_SAMPLER2D_ARG(gLight), input.uv, float2(1.0 / gViewportSize.x, 0.0), first, pairs); \
} \
float4 AlongY##samples##PS(TgQuadVarying input) : SV_Target0 \
{ \
    return along(TG_SAMPLER2D_ARG(gScatterX), input.uv, float2(0.0, 1.0 / gViewportSize.y), first, pairs); \
}

float4 along(TG_SAMPLER2D_PARAM(map), float2 uv, float2 axis, int first, int pairs)
{
    float2 frustum = tgScreenFrustum(gProjection);
    return tgSeparableConvolve(TG_SAMPLER2D_ARG(map), TG_SAMPLER2D_ARG(gDepth), TG_SAMPLER2D_ARG_OF(gBetween, gShadeMap), uv, axis, frustum,
                             gSeparableUnit, gSeparableStrength, first, pairs);
}

SEPARABLE_STEPS(7, 0, 3)
SEPARABLE_STEPS(11, 4, 5)
SEPARABLE_STEPS(17, 10, 8)
SEPARABLE_STEPS(25, 19, 12)

#endif
// SPDX-License-Identifier: MIT
