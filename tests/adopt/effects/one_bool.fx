// One construct: bool.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
bool bb = true; bool4 b4 = bool4(true,false,true,false); int4 ii = {1,2,3,4}; float4 PS(V v) : COLOR { if (bb) return b4; return ii; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
