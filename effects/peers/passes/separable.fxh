// Passes AlongX and AlongY: the light of gLightMap blurred along the axes of the picture into gScatterMap.
#ifndef TEGUMENT_PEERS_PASSES_SEPARABLE_FXH
#define TEGUMENT_PEERS_PASSES_SEPARABLE_FXH

float3 gSeparableStrength < string UIName = "Strength"; string UIWidget = "Color"; float UIMin = 0.0; float UIMax = 1.0;
    string UIHelp = "share of each colour that diffuses"; > = { 1.0, 1.0, 1.0 };
float gSeparableUnit < string UIName = "Width"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 10.0; float UIStep = 0.01;
    string UIHelp = "mm for each unit of the kernel; corrected: 1 is the skin profile"; > = TG_PEER_SEPARABLE_UNIT;

Texture2D gScatterXMap : RENDERCOLORTARGET < float2 ViewportRatio = { 1.0, 1.0 }; int MipLevels = 1; string Format = "A16B16G16R16F"; >;
TG_SAMPLER2D(gScatterX, LINEAR, CLAMP);
TG_SAMPLER2D_OF(gBetween, gShadeMap, LINEAR, CLAMP);

// Rows of the kernels' tables: the first, and how many pairs of samples follow.
float4 alongX(float2 uv, int first, int pairs)
{
    float2 axis = float2(1.0 / gViewportSize.x, 0.0);
    float2 frustum = tgScreenFrustum(gProjection);
    return tgSeparableConvolve(TG_SAMPLER2D_ARG(gLight), TG_SAMPLER2D_ARG(gDepth), TG_SAMPLER2D_ARG_OF(gBetween, gShadeMap), uv, axis,
        frustum, gSeparableUnit,
                             gSeparableStrength, first, pairs);
}

float4 alongY(float2 uv, int first, int pairs)
{
    float2 axis = float2(0.0, 1.0 / gViewportSize.y);
    float2 frustum = tgScreenFrustum(gProjection);
    return tgSeparableConvolve(TG_SAMPLER2D_ARG(gScatterX), TG_SAMPLER2D_ARG(gDepth), TG_SAMPLER2D_ARG_OF(gBetween, gShadeMap), uv, axis,
        frustum, gSeparableUnit,
                             gSeparableStrength, first, pairs);
}

float4 AlongX7PS(QuadVarying input) : SV_Target0
{
    return alongX(input.uv, 0, 3);
}

float4 AlongY7PS(QuadVarying input) : SV_Target0
{
    return alongY(input.uv, 0, 3);
}

float4 AlongX11PS(QuadVarying input) : SV_Target0
{
    return alongX(input.uv, 4, 5);
}

float4 AlongY11PS(QuadVarying input) : SV_Target0
{
    return alongY(input.uv, 4, 5);
}

float4 AlongX17PS(QuadVarying input) : SV_Target0
{
    return alongX(input.uv, 10, 8);
}

float4 AlongY17PS(QuadVarying input) : SV_Target0
{
    return alongY(input.uv, 10, 8);
}

float4 AlongX25PS(QuadVarying input) : SV_Target0
{
    return alongX(input.uv, 19, 12);
}

float4 AlongY25PS(QuadVarying input) : SV_Target0
{
    return alongY(input.uv, 19, 12);
}

#endif
