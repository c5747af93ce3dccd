// One construct: neg.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
float4 PS(V v) : COLOR { float3 n = normalize(v.t.xyx - 0.5); return float4(pow(n, 2), 1) + sqrt(-v.t.x) + log(v.t.x) * 0.01 + 1 / (v.t.x - v.t.x + 0.1) * 0.01; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
