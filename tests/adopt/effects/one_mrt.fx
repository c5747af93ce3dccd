// One construct: mrt.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
struct O { half4 a : COLOR0; float4 b : COLOR1; float4 c : COLOR2; }; O PS(V v) { O o; o.a = v.t.xyxy; o.b = 0; o.c = 1; return o; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
