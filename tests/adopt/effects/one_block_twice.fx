// One state block for two passes; the second one adds.
float4x4 gWvp : WORLDVIEWPROJECTION;
void VS(inout float4 p : POSITION, float2 uv : TEXCOORD0, out float2 at : TEXCOORD0) { p = mul(p, gWvp); at = uv; }
float4 Ramp(float2 at : TEXCOORD0) : COLOR { return float4(at, 0, 1); }
float4 Blue() : COLOR { return float4(0, 0, 0.6, 1); }
stateblock gMesh = stateblock_state { ZFunc = LESSEQUAL; AlphaBlendEnable = TRUE; SrcBlend = ONE; DestBlend = ONE; VertexShader = compile vs_2_0 VS(); };
technique T
{
    pass First { StateBlock = (gMesh); AlphaBlendEnable = FALSE; PixelShader = compile ps_2_0 Ramp(); }
    pass Second { PixelShader = compile ps_2_0 Blue(); StateBlock = (gMesh); }
}
