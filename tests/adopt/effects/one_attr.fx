// One construct: attr.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
float4 PS(V v) : COLOR { float4 c = 0; [unroll(4)] for (int i = 0; i < 4; i++) c += 0.1; [branch] if (v.t.x > 0.5) c.r = 1; [flatten] if (v.t.y > 0.5) c.g = 1; return c; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
