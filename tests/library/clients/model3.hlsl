// Shader model 3: a sampler2D is texture and sampler in one.
#define TEGUMENT_HLSL_3
#include "tegument.hlsl"
sampler2D gShadow;
float4 main(float4 lightClip : TEXCOORD0, float3 normal : TEXCOORD1, float3 toLight : TEXCOORD2, float3 toEye : TEXCOORD3) : COLOR0
{
    float depth = tgShadowDepth(lightClip, toLight);
    float lit = tgShadowTest(TG_SAMPLER2D_ARG(gShadow), tgShadowCoordinate(lightClip), depth, TG_SKIN_SHADOW_TOLERANCE, float2(0.0, 0.0));
    return lit * tgKelemenSpecular(tgSafeNormalize(normal), tgSafeNormalize(toLight), tgSafeNormalize(toEye), 0.3, 1.0);
}
