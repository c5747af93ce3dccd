#ifndef SHADERMODEL
#define SHADERMODEL
#define ENGINE_UNIFORM_SAMPLER2D(tex, regist) uniform sampler2D tex : register(S##regist)
#define ENGINE_TEX2D(tex, coords) tex2D(tex, coords)
#define ENGINE_SAMPLER2D(tex) sampler2D tex
#define TARGET0 COLOR0
#define float2x3X float2x3
struct ConnectData { float4 hpos : POSITION; float2 outTexCoord : TEXCOORD0; float3x3 worldToTangent : TEXCOORD1; float3 toEye : TEXCOORD4; };
#endif
