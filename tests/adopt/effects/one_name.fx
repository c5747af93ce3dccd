// One construct: name.
float4x4 m : WORLDVIEWPROJECTION; texture tx; sampler2D s = sampler_state { Texture = <tx>; }; struct V { float4 p : POSITION; float2 t : TEXCOORD0; }; V VS(float4 p : POSITION, float2 t : TEXCOORD0) { V v; v.p = mul(p, m); v.t = t; return v; }
float4 texture0Color = 1; float sampler0 = 0.5; float4 Color : DIFFUSE; float3 input = 1; float4 PS(V output) : COLOR { float4 result = Color * texture0Color; result.rgb *= input * sampler0; result.rg += output.t; return result; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
