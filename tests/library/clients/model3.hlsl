// Shader model 3: a sampler2D is texture and sampler in one.
#define TEGUMENT_HLSL_3
#include "tegument.hlsl"
sampler2D gShadow;
float4 main(float4 lightClip : TEXCOORD0, float3 normal : TEXCOORD1, float3 toLight : TEXCOORD2, float3 toEye : TEXCOORD3) : COLOR0
{
    float depth = shadowDepth(lightClip, toLight);
    float lit = shadowTest(SAMPLER2D_ARG(gShadow), shadowCoordinate(lightClip), depth, SKIN_SHADOW_TOLERANCE, float2(0.0, 0.0));
    return lit * kelemenSpecular(safeNormalize(normal), safeNormalize(toLight), safeNormalize(toEye), 0.3, 0.18);
}
