#if OPENGL
#define VS_SHADERMODEL vs_3_0
#define PS_SHADERMODEL ps_3_0
#else
#define VS_SHADERMODEL vs_4_0_level_9_1
#define PS_SHADERMODEL ps_4_0_level_9_1
#endif
matrix WorldViewProjection;
Texture2D SpriteTexture;
sampler2D SpriteTextureSampler = sampler_state { Texture = <SpriteTexture>; };
struct VertexShaderInput { float4 Position : POSITION0; float4 Color : COLOR0; float2 uv : TEXCOORD0; };
struct VertexShaderOutput { float4 Position : SV_POSITION; float4 Color : COLOR0; float2 uv : TEXCOORD0; };
VertexShaderOutput MainVS(in VertexShaderInput input) { VertexShaderOutput output = (VertexShaderOutput)0; output.Position = mul(input.Position, WorldViewProjection); output.Color = input.Color; output.uv = input.uv; return output; }
float4 MainPS(VertexShaderOutput input) : COLOR { return input.Color * tex2D(SpriteTextureSampler, input.uv); }
technique BasicColorDrawing { pass P0 { VertexShader = compile VS_SHADERMODEL MainVS(); PixelShader = compile PS_SHADERMODEL MainPS(); } };
