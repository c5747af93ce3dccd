// One construct: unused.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
texture un; sampler3D vol = sampler_state { Texture = <un>; }; float4 bad(float3 p) { return tex3D(vol, p); } float4 PS(V v) : COLOR { return v.t.xyxy; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
