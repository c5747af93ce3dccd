// Likewise behind the texture coordinates, as a parameter of its own.
float4x4 gViewProjection : VIEWPROJECTION;
void VS(inout float4 p : POSITION, inout float2 uv : TEXCOORD0, float4x4 instance : TEXCOORD1) { p = mul(mul(p, instance), gViewProjection); }
float4 PS(float2 uv : TEXCOORD0) : COLOR { return float4(uv, 0.5, 1); }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
