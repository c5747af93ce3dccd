// Of a state and a state block the later one counts; here the mask lets green and blue through.
float4x4 gWvp : WORLDVIEWPROJECTION;
float4 VS(float4 p : POSITION) : POSITION { return mul(p, gWvp); }
float4 PS(uniform float4 colour) : COLOR { return colour; }
stateblock gRed = stateblock_state { ColorWriteEnable = RED; PixelShader = compile ps_2_0 PS(float4(1, 0.4, 0.2, 1)); };
technique T
{
    pass P { VertexShader = compile vs_2_0 VS(); StateBlock = (gRed); ColorWriteEnable = GREEN | BLUE; }
}
