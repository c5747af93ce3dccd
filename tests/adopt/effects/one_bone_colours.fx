// Whole numbers that choose a colour.
float4x4 gWvp : WORLDVIEWPROJECTION;
float4 gInks[3] = { { 1, 0.5, 0, 1 }, { 0, 1, 0, 1 }, { 0, 0, 1, 1 } };
void VS(inout float4 p : POSITION, float3 n : NORMAL, int ink : TEXCOORD3, out float4 colour : COLOR0)
{
    p = mul(p, gWvp);
    colour = gInks[ink] * saturate(n.z);
}
float4 PS(float4 colour : COLOR0) : COLOR { return colour; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
