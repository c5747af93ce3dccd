// One construct: mat.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
float4x3 a; float3x3 b; float3x4 c4; float4 PS(V v) : COLOR { float3 x = mul(float4(v.t, 0, 1), a); x = mul(x, b); x += mul(b, x); float4 y = mul(x, c4); return y + b[0].xyzz + a._m00 + b._11_12_13.xyzz + transpose(b)[1].xyzx + v.t.x; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
