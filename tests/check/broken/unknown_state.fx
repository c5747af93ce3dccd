// A misspelt state in a Direct3D 9 pass.
float4 PS(float2 uv : TEXCOORD0) : COLOR0 { return uv.xyxy; }
technique T
{
    pass P
    {
        PixelShader = compile ps_3_0 PS();
        ZEnabel = FALSE; //~ TG2001
    }
}
