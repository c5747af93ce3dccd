// expect: 2022_unknown_function.fx(5,43): error TG2022: unknown function 'BlurSP'; did you mean 'BlurPS'?
float4 BlurPS() : SV_Target0 { return 0; }
technique T
{
    pass P { PixelShader = compile ps_3_0 BlurSP(); }
}
