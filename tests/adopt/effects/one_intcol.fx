// One construct: intcol.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
int n = 3; float4 PS(V v) : COLOR { int a = v.t.x * 10; a = a % n; float f = a / 2; return float4(a / 3.0, f, fmod(v.t.y * 10, 3) / 3, 1); }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
