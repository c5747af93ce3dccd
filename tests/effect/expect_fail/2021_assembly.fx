// expect: 2021_assembly.fx(6,24): error TG2021: assembly shaders are not supported; write HLSL
technique T
{
    pass P
    {
        VertexShader = asm { vs_1_1 };
    }
}
