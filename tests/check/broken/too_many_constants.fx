// More than the 224 constant registers of ps_3_0.
#include "../../../hlsl/platform.fxh"
float4 gTable[240];
float4 gIndex;
struct V { float4 position : SV_Position; float2 uv : TEXCOORD0; };
V VS(float3 position : POSITION, float2 uv : TEXCOORD0) { V o; o.position = float4(position, 1); o.uv = uv; return o; }
float4 PS(V v) : SV_Target0
{
    float4 c = 0;
    [unroll] for (int i = 0; i < 240; i++)
        c = max(c, gTable[i]);
    return c + gIndex;
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
