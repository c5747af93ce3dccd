// Corners in pixels, by a structure whose members are given in braces.
struct Corner { float4 place : POSITION; float2 uv : TEXCOORD0; };
float2 size : VIEWPORTPIXELSIZE;
Corner VS(float4 p : POSITION, float2 uv : TEXCOORD0)
{
    Corner placed = { float4(p.x / size.x * 2 - 1, 1 - p.y / size.y * 2, 0, 1), uv };
    return placed;
}
float4 PS(float2 uv : TEXCOORD0) : COLOR { return float4(uv, 0.5, 1); }
technique T { pass P { ZEnable = FALSE; VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
