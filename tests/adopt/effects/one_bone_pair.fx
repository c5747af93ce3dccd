// Two bones and their share, which is no whole number.
float4x4 gViewProjection : VIEWPROJECTION;
float4x3 gPalette[8] : WORLDMATRIXARRAY;
void VS(inout float4 p : POSITION, int4 bones : TEXCOORD1, float2 share : TEXCOORD2, out float2 uv : TEXCOORD0)
{
    p = mul(float4(lerp(mul(p, gPalette[bones.x]), mul(p, gPalette[bones.y]), share.x), 1), gViewProjection);
    uv = share;
}
float4 PS(float2 uv : TEXCOORD0) : COLOR { return float4(uv.y, uv.x, 0, 1); }
technique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
