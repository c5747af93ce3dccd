// More than the 512 instruction slots of shader model 3.
#include "../../../hlsl/platform.fxh"
float4 gX;
struct V { float4 position : SV_Position; float2 uv : TEXCOORD0; };
V VS(float3 position : POSITION, float2 uv : TEXCOORD0) { V o; o.position = float4(position, 1); o.uv = uv; return o; }
float4 PS(V v) : SV_Target0
{
    float4 c = v.uv.xyxy;
    [unroll] for (int i = 0; i < 550; i++)
        c = c * c + gX;
    return c;
}
#ifdef FX_TECHNIQUES
technique T
{
    pass P
    {
        VertexShader = compile TG_VS_MODEL VS();
        PixelShader = compile TG_PS_MODEL PS(); //~ fx_2_0 TG3203
        TG_STATE_BUFFER;
    }
}
#endif
