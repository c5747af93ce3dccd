cbuffer cbPerFrame { matrix World; matrix View; matrix Projection; float3 lightDir = float3(0.5, 1, 0.5); float4 colour = float4(1, 0.6, 0.3, 1); };
Texture2D g_txDiffuse; SamplerState samLinear { Filter = MIN_MAG_MIP_LINEAR; AddressU = Wrap; AddressV = Wrap; };
struct VS_INPUT { float4 Pos : POSITION; float3 Norm : NORMAL; float2 Tex : TEXCOORD; };
struct PS_INPUT { float4 Pos : SV_POSITION; float3 Norm : NORMAL; float2 Tex : TEXCOORD0; };
PS_INPUT VS(VS_INPUT input) { PS_INPUT output = (PS_INPUT)0; output.Pos = mul(mul(mul(input.Pos, World), View), Projection); output.Norm = mul(input.Norm, (float3x3)World); output.Tex = input.Tex; return output; }
float4 PS(PS_INPUT input, uniform bool lit2) : SV_Target { float l = saturate(dot(normalize(input.Norm), normalize(lightDir))); return g_txDiffuse.Sample(samLinear, input.Tex) * (lit2 ? l : 1) * colour; }
technique10 Render { pass P0 { SetVertexShader(CompileShader(vs_4_0, VS())); SetGeometryShader(NULL); SetPixelShader(CompileShader(ps_4_0, PS(true))); } }
