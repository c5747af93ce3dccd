// expect: 2019_unknown_state_object.fx(7,23): error TG2019: unknown BlendState 'gBlendOf'; did you mean 'gBlendOff'?
BlendState gBlendOff { BlendEnable[0] = FALSE; };
technique11 T
{
    pass P
    {
        SetBlendState(gBlendOf, float4(0, 0, 0, 0), 0xffffffff);
    }
}
