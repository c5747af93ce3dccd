// One construct: array.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
float4 k[3]; float w[5] = {1,2,3,4,5}; float4 PS(V v) : COLOR { float4 l[3] = { k[0], k[1], k[2] }; float sum = 0; for (int i = 0; i < 5; i++) sum += w[i]; l[1].x = sum; return l[1] * 0.05 + v.t.xyxy; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
