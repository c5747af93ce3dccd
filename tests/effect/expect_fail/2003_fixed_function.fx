// expect: 2003_fixed_function.fx(6,9): error TG2003: fixed-function state FogEnable: not expressible; write it in a shader
technique T
{
    pass P
    {
        FogEnable = TRUE;
    }
}
