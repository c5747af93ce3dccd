// One construct: inc.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
static const float2 taps[4] = { {-1,0}, {1,0}, {0,-1}, {0,1} }; float4 PS(V v) : COLOR { float4 c = 0; for (int i = 0; i < 4; i++) c += tex2D(s, v.t + taps[i] * 0.02) * 0.25; return c; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
