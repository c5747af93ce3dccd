// Likewise with fewer columns, before the place in the list of inputs.
float4x4 gViewProjection : VIEWPROJECTION;
void VS(float4x3 instance : TEXCOORD2, float3 n : NORMAL, inout float4 p : POSITION, out float shade : COLOR0)
{
    p = mul(float4(mul(p, instance), 1), gViewProjection);
    shade = saturate(mul(n, (float3x3)instance).z);
}
float4 PS(float shade : COLOR0) : COLOR { return shade; }
technique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
