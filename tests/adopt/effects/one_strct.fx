// One construct: strct.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
struct M { float3 d; float p; }; struct L { M m; float3 c[2]; }; L lights[2]; M one = { 1, 0.5, 0, 8 }; float3 shade(M m, float2 t) { return m.d * m.p * t.x; } float4 PS(V v) : COLOR { M z = one; z.p *= 0.5; return float4(shade(z, v.t) + shade(lights[1].m, v.t) + lights[0].c[1], 1); }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
