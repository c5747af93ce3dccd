// Pass ShadowMap: depth of the mesh seen from the light into gShadowMap. R32F, because one step of a half is 0.5 mm at 600 mm.
#ifndef TEGUMENT_PASSES_SHADOW_MAP_FXH
#define TEGUMENT_PASSES_SHADOW_MAP_FXH

Texture2D gShadowMap : RENDERCOLORTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE; int MipLevels = 1;
    string Format = "R32F"; >;
Texture2D gShadowDepthMap : RENDERDEPTHSTENCILTARGET < int Width = TEGUMENT_MAP_SIZE; int Height = TEGUMENT_MAP_SIZE;
    string Format = "D24S8"; >;
TG_SAMPLER2D(gShadow, POINT, CLAMP);

struct ShadowVarying
{
    float4 position : SV_Position;
    float3 toLight : TEXCOORD0; // mm
    float4 lightClip : TEXCOORD1;
};

ShadowVarying ShadowMapVS(TgMeshInput input)
{
    ShadowVarying output;
    float3 world = tgWorldPosition(input.position);
    output.lightClip = mul(float4(world, 1.0), gLightViewProjection);
    output.position = TG_HALF_PIXEL(output.lightClip, gViewportSize);
    output.toLight = tgMillimetres(tgLightVector(world));
    return output;
}

float4 ShadowMapPS(ShadowVarying input) : SV_Target0
{
    return float4(tgShadowDepth(input.lightClip, input.toLight), 0.0, 0.0, 1.0);
}

#endif
