// Shader models 4 to 6 and SPIR-V: a texture and a sampler, of whatever names. What a client calls technique or tex2D is the client's.
#define TEGUMENT_MAP_SIZE 512
#include "tegument.hlsl"
Texture2D depths;
SamplerState nearest;
float4 main(float4 lightClip : TEXCOORD0, float3 normal : TEXCOORD1, float3 toLight : TEXCOORD2, float3 toEye : TEXCOORD3) : SV_Target0
{
    float2 place = tgShadowCoordinate(lightClip);
    float lit = tgShadowTest(TG_SAMPLER2D_ARG_OF(nearest, depths), place, tgShadowDepth(lightClip, toLight), 0.3, float2(0.0, 0.0));
    return lit * tgKelemenSpecular(tgSafeNormalize(normal), tgSafeNormalize(toLight), tgSafeNormalize(toEye), 0.3, 1.0);
}
