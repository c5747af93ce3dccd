// expect: 2001_unknown_state.fx(8,9): error TG2001: unknown render state 'ZWriteEnabled'; did you mean 'ZWriteEnable'?
float4 P() : SV_Target0 { return 0; }
technique T
{
    pass P
    {
        PixelShader = compile ps_3_0 P();
        ZWriteEnabled = TRUE;
    }
}
