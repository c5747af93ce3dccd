// Lit vertices for the fixed-function pixel pipeline.
float4x4 mTot : WORLDVIEWPROJECTION;
float4x4 mWld : WORLD;
float4 vecLightDir;
struct VS_OUT { float4 Pos : POSITION; float4 Col : COLOR0; float Fog : FOG; float Size : PSIZE; };
VS_OUT VS(float4 p : POSITION, float3 n : NORMAL) { VS_OUT o = (VS_OUT)0; o.Pos = mul(p, mTot); float d = dot(mul(n, (float3x3)mWld), vecLightDir.xyz); o.Col = float4(max(d, 0.1).xxx * float3(2, 1, 0.5), 1); o.Fog = 1; return o; }
technique T { pass P { Lighting = FALSE; SpecularEnable = TRUE; ColorOp[0] = SelectArg1; ColorArg1[0] = Diffuse; VertexShader = compile vs_1_1 VS(); PixelShader = NULL; } }
