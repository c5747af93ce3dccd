// The pixel shader reads what no vertex shader writes.
#include "../../../hlsl/platform.fxh"
struct V { float4 position : SV_Position; float2 uv : TEXCOORD0; };
V VS(float3 position : POSITION, float2 uv : TEXCOORD0) { V o; o.position = float4(position, 1); o.uv = uv; return o; }
float4 PS(float2 uv : TEXCOORD5) : SV_Target0 { return uv.xyxy; }
#ifdef FX_TECHNIQUES
technique T
{
    pass P
    {
        VertexShader = compile TG_VS_MODEL VS();
        PixelShader = compile TG_PS_MODEL PS(); //~ fx_4_0 fx_5_0 TG3101, else TG3004
        TG_STATE_BUFFER;
    }
}
#endif
