// Corners in pixels, as sprites have them.
float2 ViewportSize;
void VS(float4 p : POSITION, inout float2 uv : TEXCOORD0, out float4 o : POSITION) { o = float4((p.xy / ViewportSize * 2 - 1) * float2(1, -1), 0, 1); }
float4 PS(float2 uv : TEXCOORD0) : COLOR { return float4(uv, 0.5, 1); }
technique T { pass P { ZEnable = FALSE; VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
