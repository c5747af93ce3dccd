// One construct: while.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
float4 PS(V v) : COLOR { int i = 0; float4 c = 0; while (i < 4) { c += tex2Dlod(s, float4(v.t, 0, i)); i++; } do { i--; } while (i > 0); switch (i) { case 0: c *= 0.3; break; default: break; } return c * v.t.x; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
