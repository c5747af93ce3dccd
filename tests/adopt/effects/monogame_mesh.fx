#if OPENGL
#define SV_POSITION POSITION
#define VS_SHADERMODEL vs_3_0
#define PS_SHADERMODEL ps_3_0
#else
#define VS_SHADERMODEL vs_4_0
#define PS_SHADERMODEL ps_4_0
#endif
#ifndef MAX_BONES
#define MAX_BONES 72
#endif
matrix World, View, Projection;
float4x3 Bones[MAX_BONES];
float3 CameraPosition;
float3 LightDirection = float3(-0.5, -0.7, -0.5);
float Shininess = 24;
#if OPENGL
texture Diffuse; sampler2D DiffuseSampler = sampler_state { Texture = (Diffuse); MinFilter = Anisotropic; MaxAnisotropy = 8; };
#define SAMPLE(uv) tex2D(DiffuseSampler, uv)
#else
Texture2D Diffuse; SamplerState DiffuseSampler { Filter = ANISOTROPIC; MaxAnisotropy = 8; AddressU = Wrap; AddressV = Wrap; };
#define SAMPLE(uv) Diffuse.Sample(DiffuseSampler, uv)
#endif
struct In { float4 Position : POSITION0; float3 Normal : NORMAL0; float2 Uv : TEXCOORD0; uint4 Indices : BLENDINDICES0; float4 Weights : BLENDWEIGHT0; };
struct Out { float4 Position : SV_POSITION; float3 Normal : TEXCOORD0; float2 Uv : TEXCOORD1; float3 Where : TEXCOORD2; };
void Skin(inout In vin, uniform int boneCount)
{
    float4x3 skinning = 0;
    [unroll]
    for (int i = 0; i < boneCount; i++)
        skinning += Bones[vin.Indices[i]] * vin.Weights[i];
    vin.Position.xyz = mul(vin.Position, skinning);
    vin.Normal = mul(vin.Normal, (float3x3)skinning);
}
Out MainVS(In input)
{
    Out output = (Out)0;
    Skin(input, 4);
    float4 world = mul(input.Position, World);
    output.Position = mul(mul(world, View), Projection);
    output.Where = world.xyz;
    output.Normal = mul(input.Normal, (float3x3)World);
    output.Uv = input.Uv;
    return output;
}
float4 MainPS(Out input) : SV_TARGET
{
    float3 n = normalize(input.Normal);
    float3 v = normalize(CameraPosition - input.Where);
    float3 h = normalize(v - LightDirection);
    return SAMPLE(input.Uv) * (saturate(dot(n, -LightDirection)) + 0.2) + pow(saturate(dot(n, h)), Shininess) * 0.4;
}
technique Skinned { pass P0 { VertexShader = compile VS_SHADERMODEL MainVS(); PixelShader = compile PS_SHADERMODEL MainPS(); } };
