// One construct: const.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
const float3 lum = float3(0.3, 0.59, 0.11); const float big[4] = {1,2,3,4}; float4 PS(V v) : COLOR { const float3 l2 = lum; return dot(tex2D(s, v.t).rgb, l2) * big[2] * 0.3; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
