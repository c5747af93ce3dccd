// MonoGame's macros: one source for two languages.
#ifdef SM4
#define TECHNIQUE(name, vsname, psname) technique name { pass { VertexShader = compile vs_4_0_level_9_1 vsname(); PixelShader = compile ps_4_0_level_9_1 psname(); } }
#define BEGIN_CONSTANTS cbuffer Parameters : register(b0) {
#define END_CONSTANTS };
#define _vs(r) : register(vs, r)
#define DECLARE_TEXTURE(Name, index) Texture2D<float4> Name : register(t##index); sampler Name##Sampler : register(s##index)
#define SAMPLE_TEXTURE(Name, texCoord) Name.Sample(Name##Sampler, texCoord)
#else
#define TECHNIQUE(name, vsname, psname) technique name { pass { VertexShader = compile vs_2_0 vsname(); PixelShader = compile ps_2_0 psname(); } }
#define BEGIN_CONSTANTS
#define END_CONSTANTS
#define _vs(r) : register(vs, r)
#define DECLARE_TEXTURE(Name, index) sampler2D Name : register(s##index);
#define SAMPLE_TEXTURE(Name, texCoord) tex2D(Name, texCoord)
#endif
DECLARE_TEXTURE(Texture, 0);
BEGIN_CONSTANTS
float4 DiffuseColor _vs(c0) = { 0.9, 0.7, 0.5, 1 };
float3 FogColor;
float4x4 WorldViewProj _vs(c15);
END_CONSTANTS
struct VSOutputTx { float4 PositionPS : SV_Position; float4 Diffuse : COLOR0; float2 TexCoord : TEXCOORD0; };
VSOutputTx VSBasic(float4 Position : SV_Position, float2 TexCoord : TEXCOORD0) { VSOutputTx v; v.PositionPS = mul(Position, WorldViewProj); v.Diffuse = DiffuseColor; v.TexCoord = TexCoord; return v; }
float4 PSBasic(VSOutputTx pin) : SV_Target0 { float4 c = SAMPLE_TEXTURE(Texture, pin.TexCoord) * pin.Diffuse; return c; }
TECHNIQUE(BasicEffect, VSBasic, PSBasic);
