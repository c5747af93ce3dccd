// One construct: out.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
void f(out float4 c, inout float2 t, float s = 1) { c = t.xyxy * s; t += 1; } float4 PS(V v) : COLOR { float4 c; float2 t = v.t; f(c, t, 2); return c; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
