// One construct: macro.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
#define TEX(n) texture n##Tex; sampler n##Smp = sampler_state { Texture = <n##Tex>; };
TEX(one) TEX(two)
float4 PS(V v) : COLOR { return tex2D(oneSmp, v.t) * tex2D(twoSmp, v.t * 2); }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
